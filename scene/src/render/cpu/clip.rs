//! From a triangle in clip space to triangles on the screen.

use glam::{DMat3, DVec3, UVec2, Vec3, Vec4, dvec3};

/// Steps that screen coordinates are rounded to in a pixel, as GPUs do: edges that two triangles share are then
/// the same numbers, and no pixel between them is lost or drawn twice.
pub(super) const STEPS: i32 = 256;

/// Distance to which triangles may reach beyond the picture's centre, in half sizes: they are cut there, so that screen
/// coordinates of any picture stay small.
const GUARD: f32 = 8.0;

/// A triangle, or a piece of one, that may be seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScreenTriangle {
    /// Corners in steps from the picture's upper left corner, clockwise as seen (y down), of an area above 0.
    pub corners: [[i32; 2]; 3],
    /// Index of the whole triangle in the scene.
    pub source: u32,
    /// True if the side that normals point to is seen.
    pub front: bool,
    /// Linear depth at the whole triangle's corners.
    pub depths: Vec3,
    /// Smallest and largest nearness (clip-space z/w) in this piece. Between pixels and rounded corners, planes seen
    /// edge-on would reach beyond.
    pub reach: [f32; 2],
    /// Takes a place on the screen, (x, y, 1) in -1..=1, to the shares of the whole triangle's corners there,
    /// divided by depth. They are the homogeneous barycentric coordinates (Olano and Greer 1997), which exist
    /// even where corners lie behind the camera.
    to_shares: DMat3,
    /// Clip-space z of the whole triangle's corners.
    nearness: Vec3,
}

impl ScreenTriangle {
    /// Returns the shares of the whole triangle's corners at the centre of `pixel`; their sum is 1.
    pub fn corner_shares(&self, pixel: UVec2, size: UVec2) -> DVec3 {
        let shares = (self.to_shares * screen_position(pixel.as_dvec2().to_array(), size)).max(DVec3::ZERO);
        let sum = shares.element_sum();
        // A pixel at a rounded corner may lie just outside.
        if sum > 0.0 {
            shares / sum
        } else {
            DVec3::splat(1.0 / 3.0)
        }
    }

    /// The nearness at the centre of pixel (0, y), and how it grows from pixel to pixel to the right. It is linear on the
    /// screen in either projection.
    pub fn nearness_row(&self, y: u32, size: UVec2) -> (f64, f64) {
        let total = self.to_shares.transpose() * self.nearness.as_dvec3();
        let start = total.dot(screen_position([0.0, f64::from(y)], size));
        (start, total.x * 2.0 / f64::from(size.x))
    }
}

/// The centre of pixel (x, y) on the screen, -1..=1 from left to right and from bottom to top.
fn screen_position([x, y]: [f64; 2], size: UVec2) -> DVec3 {
    let size = size.as_dvec2();
    dvec3((x + 0.5) * 2.0 / size.x - 1.0, 1.0 - (y + 0.5) * 2.0 / size.y, 1.0)
}

/// The pieces of a triangle with clip-space `corners` at linear `depths` that a picture of `size` shows.
pub(super) fn project_triangle(source: u32, corners: [Vec4; 3], depths: Vec3, size: UVec2) -> Pieces {
    let mut pieces = Pieces {
        found: [None; MAX_CORNERS - 2],
        next: 0,
    };
    // All corners are outside one edge of the picture, in front of the near plane, or beyond the far one.
    let outside = |far: fn(Vec4) -> bool| corners.iter().all(|corner| far(*corner));
    if outside(|c| c.x > c.w)
        || outside(|c| c.x < -c.w)
        || outside(|c| c.y > c.w)
        || outside(|c| c.y < -c.w)
        || outside(|c| c.z > c.w)
        || outside(|c| c.z < 0.0)
    {
        return pieces;
    }
    let columns = corners.map(|corner| dvec3(corner.x.into(), corner.y.into(), corner.w.into()));
    let to_clip = DMat3::from_cols(columns[0], columns[1], columns[2]);
    let determinant = to_clip.determinant();
    // Seen edge-on it has no area.
    if determinant == 0.0 || !determinant.is_finite() {
        return pieces;
    }
    let whole = ScreenTriangle {
        corners: [[0; 2]; 3],
        source,
        front: determinant > 0.0,
        depths,
        reach: [0.0; 2],
        to_shares: to_clip.inverse(),
        nearness: Vec3::from(corners.map(|corner| corner.z)),
    };
    let polygon = Polygon::from_triangle(corners).clip_to_view();
    let screen = |corner: &Vec4| {
        let step = |place: f32, side: u32| ((0.5 + 0.5 * place) * (side as f32 * STEPS as f32)).round() as i32;
        [step(corner.x / corner.w, size.x), step(-corner.y / corner.w, size.y)]
    };
    for (i, found) in pieces
        .found
        .iter_mut()
        .enumerate()
        .take(polygon.count.saturating_sub(2))
    {
        let piece = [0, i + 1, i + 2].map(|at| polygon.corners[at]);
        let [a, b, c] = piece.each_ref().map(screen);
        let area = doubled_area(a, b, c);
        if area != 0 {
            let nearness = piece.map(|corner| corner.z / corner.w);
            *found = Some(ScreenTriangle {
                corners: if area > 0 { [a, b, c] } else { [a, c, b] },
                reach: [
                    nearness.into_iter().fold(f32::INFINITY, f32::min),
                    nearness.into_iter().fold(0.0, f32::max),
                ],
                ..whole
            });
        }
    }
    pieces
}

fn doubled_area([ax, ay]: [i32; 2], [bx, by]: [i32; 2], [cx, cy]: [i32; 2]) -> i64 {
    i64::from(bx - ax) * i64::from(cy - ay) - i64::from(by - ay) * i64::from(cx - ax)
}

/// Each of the six planes can add a corner to a triangle.
const MAX_CORNERS: usize = 9;

/// Pieces of one triangle.
pub(super) struct Pieces {
    found: [Option<ScreenTriangle>; MAX_CORNERS - 2],
    next: usize,
}

impl Iterator for Pieces {
    type Item = ScreenTriangle;

    fn next(&mut self) -> Option<ScreenTriangle> {
        let left = self.found.get(self.next..)?;
        let at = left.iter().position(Option::is_some)?;
        self.next += at + 1;
        left[at]
    }
}

/// A convex polygon in clip space.
struct Polygon {
    corners: [Vec4; MAX_CORNERS],
    count: usize,
}

impl Polygon {
    fn from_triangle(triangle: [Vec4; 3]) -> Self {
        let mut polygon = Polygon {
            corners: [Vec4::ZERO; MAX_CORNERS],
            count: 0,
        };
        triangle.into_iter().for_each(|corner| polygon.push(corner));
        polygon
    }

    fn push(&mut self, corner: Vec4) {
        // A convex polygon gains at most one corner at each plane; rounding must not make it more.
        if self.count < MAX_CORNERS {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// The part between the near and the far plane and within the guard band.
    fn clip_to_view(self) -> Polygon {
        self.cut(|corner| corner.w - corner.z)
            .cut(|corner| corner.z)
            .cut(|corner| GUARD * corner.w - corner.x)
            .cut(|corner| GUARD * corner.w + corner.x)
            .cut(|corner| GUARD * corner.w - corner.y)
            .cut(|corner| GUARD * corner.w + corner.y)
    }

    /// The part where `distance`, linear in a corner's coordinates, is not negative (Sutherland and Hodgman 1974).
    fn cut(self, distance: impl Fn(Vec4) -> f32) -> Polygon {
        let corners = &self.corners[..self.count];
        if corners.iter().all(|corner| distance(*corner) >= 0.0) {
            return self;
        }
        let mut rest = Polygon {
            corners: [Vec4::ZERO; MAX_CORNERS],
            count: 0,
        };
        for (i, here) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let (from, to) = (distance(*here), distance(next));
            if from >= 0.0 {
                rest.push(*here);
            }
            if (from >= 0.0) != (to >= 0.0) {
                rest.push(here.lerp(next, from / (from - to)));
            }
        }
        rest
    }
}
