//! Enhanced subpixel morphological antialiasing, second pass: blending weights of each pixel (Jimenez, Echevarria, Sousa and
//! Gutierrez, SMAA, 2012; after the reference implementation, MIT licence, https://github.com/iryoku/smaa), preset High.
//!
//! `area` and `search` are the reference's tables: `smaa_area.png`, 160×560, and `smaa_search.png`, 64×16.

use straightline_kernels::prelude::*;

const SEARCH_STEPS: f32 = 16.0;
const SEARCH_STEPS_DIAGONAL: f32 = 8.0;
const CORNER_ROUNDING: f32 = 0.25;
const AREA_DISTANCE: f32 = 16.0;
const AREA_DISTANCE_DIAGONAL: f32 = 20.0;

/// Inputs of all steps. Coordinates are from 0 to 1, like a sampler's; `texel` is the size of a pixel.
struct Edges<'a> {
    edges: &'a Frame<Vec4>,
    area: &'a Texture<Vec4>,
    search: &'a Texture<Vec4>,
    linear: &'a Sampler,
    texel: Vec2,
}

impl Edges<'_> {
    fn sample(&self, at: Vec2) -> Vec2 {
        self.edges.sample(self.linear, at).xy()
    }

    fn area(&self, texel: Vec2) -> Vec2 {
        self.area.sample(self.linear, (texel + 0.5) / vec2(160.0, 560.0)).xy()
    }

    /// Length of the edge within the last two pixels of a search, as a fraction of 255.
    fn last_length(&self, e: Vec2, side: f32) -> f32 {
        let scale = vec2(66.0, 33.0) * vec2(0.5, -1.0) + vec2(-1.0, 1.0);
        let bias = vec2(66.0, 33.0) * vec2(side, 1.0) + vec2(0.5, -0.5);
        self.search.sample(self.linear, (scale * e + bias) / vec2(64.0, 16.0)).x
    }

    /// Returns the end of a horizontal edge. `direction` is -1 for left or 1 for right.
    fn search_x(&self, from: Vec2, direction: f32, end: f32) -> f32 {
        let mut at = from;
        let mut e = vec2(0.0, 1.0);
        while (end - at.x) * direction > 0.0 && e.y > 0.8281 && e.x == 0.0 {
            e = self.sample(at);
            at.x += 2.0 * direction * self.texel.x;
        }
        let side = if direction < 0.0 { 0.0 } else { 0.5 };
        at.x - direction * self.texel.x * (3.25 - 255.0 / 127.0 * self.last_length(e, side))
    }

    /// Returns the end of a vertical edge. `direction` is -1 for up or 1 for down.
    fn search_y(&self, from: Vec2, direction: f32, end: f32) -> f32 {
        let mut at = from;
        let mut e = vec2(1.0, 0.0);
        while (end - at.y) * direction > 0.0 && e.x > 0.8281 && e.y == 0.0 {
            e = self.sample(at);
            at.y += 2.0 * direction * self.texel.y;
        }
        let side = if direction < 0.0 { 0.0 } else { 0.5 };
        at.y - direction * self.texel.y * (3.25 - 255.0 / 127.0 * self.last_length(e.yx(), side))
    }

    /// Searches a diagonal. Returns its length, a value below 0.9 if it ended, and the edges at its end.
    fn search_diagonal(&self, from: Vec2, direction: Vec2) -> (f32, f32, Vec2) {
        let (mut length, mut found, mut e) = (-1.0, 1.0, Vec2::ZERO);
        let mut at = from;
        while length < SEARCH_STEPS_DIAGONAL - 1.0 && found > 0.9 {
            at += direction * self.texel;
            length += 1.0;
            e = self.sample(at);
            found = 0.5 * (e.x + e.y);
        }
        (length, found, e)
    }

    /// Searches the other diagonal, with two edges per read. Returns the same values.
    fn search_other_diagonal(&self, from: Vec2, direction: Vec2) -> (f32, f32, Vec2) {
        let (mut length, mut found, mut e) = (-1.0, 1.0, Vec2::ZERO);
        let mut at = from + vec2(0.25 * self.texel.x, 0.0);
        while length < SEARCH_STEPS_DIAGONAL - 1.0 && found > 0.9 {
            at += direction * self.texel;
            length += 1.0;
            e = decoded(self.sample(at));
            found = 0.5 * (e.x + e.y);
        }
        (length, found, e)
    }

    fn area_diagonal(&self, lengths: Vec2, crossing: Vec2) -> Vec2 {
        self.area(AREA_DISTANCE_DIAGONAL * crossing + lengths + vec2(80.0, 0.0))
    }

    /// Weights of a pixel on a diagonal; zero if there is none.
    fn diagonal(&self, at: Vec2, e: Vec2) -> Vec2 {
        let mut weights = Vec2::ZERO;
        let (mut back, mut lost_back) = (0.0, 0.0);
        if e.x > 0.0 {
            let end;
            (back, lost_back, end) = self.search_diagonal(at, vec2(-1.0, 1.0));
            back += if end.y > 0.9 { 1.0 } else { 0.0 };
        }
        let (ahead, lost_ahead, _) = self.search_diagonal(at, vec2(1.0, -1.0));
        if back + ahead > 2.0 {
            let one = decoded(self.sample(at + vec2(0.25 - back - 1.0, back) * self.texel));
            let other = decoded(self.sample(at + vec2(ahead + 1.0, -ahead - 0.25) * self.texel));
            let mut crossing = vec2(2.0 * one.y + one.x, 2.0 * other.y + other.x);
            if lost_back >= 0.9 {
                crossing.x = 0.0;
            }
            if lost_ahead >= 0.9 {
                crossing.y = 0.0;
            }
            weights += self.area_diagonal(vec2(back, ahead), crossing);
        }

        let (back, lost_back, _) = self.search_other_diagonal(at, vec2(-1.0, -1.0));
        let (mut ahead, mut lost_ahead) = (0.0, 0.0);
        if self.sample(at + vec2(self.texel.x, 0.0)).x > 0.0 {
            let end;
            (ahead, lost_ahead, end) = self.search_other_diagonal(at, vec2(1.0, 1.0));
            ahead += if end.y > 0.9 { 1.0 } else { 0.0 };
        }
        if back + ahead > 2.0 {
            let left = self.sample(at + vec2(-back - 1.0, -back) * self.texel).y;
            let above = self.sample(at + vec2(-back, -back - 1.0) * self.texel).x;
            let other = self.sample(at + vec2(ahead + 1.0, ahead) * self.texel);
            let mut crossing = vec2(2.0 * left + above, 2.0 * other.y + other.x);
            if lost_back >= 0.9 {
                crossing.x = 0.0;
            }
            if lost_ahead >= 0.9 {
                crossing.y = 0.0;
            }
            weights += self.area_diagonal(vec2(back, ahead), crossing).yx();
        }
        weights
    }

    fn orthogonal(&self, lengths: Vec2, one: f32, other: f32) -> Vec2 {
        self.area(AREA_DISTANCE * round(4.0 * vec2(one, other)) + lengths.map(f32::sqrt))
    }
}

/// Decodes two edges from one read between them: 0.25 or 1 in x, 0.75 or 1 in y.
fn decoded(e: Vec2) -> Vec2 {
    round(vec2(e.x * (5.0 * e.x - 3.75).abs(), e.y))
}

/// Share of the weights left at each end of a line after corner rounding. The lengths to both ends decide which is nearer.
fn rounding(lengths: Vec2) -> Vec2 {
    let nearer = vec2(step(lengths.x, lengths.y), step(lengths.y, lengths.x));
    (1.0 - CORNER_ROUNDING) * nearer / (nearer.x + nearer.y)
}

pub fn smaa_weights(
    edges: &Frame<Vec4>,
    area: &Texture<Vec4>,
    search: &Texture<Vec4>,
    linear: &Sampler,
    pixel: IVec2,
) -> Vec4 {
    let size = edges.size().as_vec2();
    let texel = 1.0 / size;
    let this = Edges {
        edges,
        area,
        search,
        linear,
        texel,
    };
    let at = (pixel.as_vec2() + 0.5) * texel;
    let reach = 2.0 * SEARCH_STEPS * texel;
    let mut e = edges.load(pixel).xy();
    let (mut horizontal, mut vertical) = (Vec2::ZERO, Vec2::ZERO);

    if e.y > 0.0 {
        horizontal = this.diagonal(at, e);
        if horizontal.x == -horizontal.y {
            // Between two rows, so that one read distinguishes four edges.
            let (from, to) = (at + texel * vec2(-0.25, -0.125), at + texel * vec2(1.25, -0.125));
            let left = this.search_x(from, -1.0, from.x - reach.x);
            let right = this.search_x(to, 1.0, to.x + reach.x);
            let lengths = round((vec2(left, right) - at.x) * size.x).abs();
            let (row, right) = (at.y - 0.25 * texel.y, right + texel.x);
            let one = this.sample(vec2(left, row)).x;
            let other = this.sample(vec2(right, row)).x;
            let weights = this.orthogonal(lengths, one, other);
            let corners = |y: f32| vec2(this.sample(vec2(left, y)).x, this.sample(vec2(right, y)).x);
            let part = rounding(lengths);
            let below = part.dot(corners(at.y + texel.y));
            let above = part.dot(corners(at.y - 2.0 * texel.y));
            horizontal = weights * saturate(1.0 - vec2(below, above));
        } else {
            e.x = 0.0;
        }
    }
    if e.x > 0.0 {
        let (from, to) = (at + texel * vec2(-0.125, -0.25), at + texel * vec2(-0.125, 1.25));
        let up = this.search_y(from, -1.0, from.y - reach.y);
        let down = this.search_y(to, 1.0, to.y + reach.y);
        let lengths = round((vec2(up, down) - at.y) * size.y).abs();
        let (column, down) = (at.x - 0.25 * texel.x, down + texel.y);
        let one = this.sample(vec2(column, up)).y;
        let other = this.sample(vec2(column, down)).y;
        let weights = this.orthogonal(lengths, one, other);
        let corners = |x: f32| vec2(this.sample(vec2(x, up)).y, this.sample(vec2(x, down)).y);
        let part = rounding(lengths);
        let right = part.dot(corners(at.x + texel.x));
        let left = part.dot(corners(at.x - 2.0 * texel.x));
        vertical = weights * saturate(1.0 - vec2(right, left));
    }
    vec4(horizontal.x, horizontal.y, vertical.x, vertical.y)
}
