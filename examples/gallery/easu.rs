//! Edge adaptive spatial upsampling (Lottes, FidelityFX Super Resolution 1.0, 2021): twelve texels, weighted by a Lanczos-like
//! kernel that is rotated and stretched along edges.

use straightline_kernels::prelude::*;

/// Twice the luma.
fn luma(c: Vec3) -> f32 {
    c.z * 0.5 + (c.x * 0.5 + c.y)
}

/// Direction and strength of an edge.
struct Edge {
    direction: Vec2,
    length: f32,
}

impl Edge {
    /// Adds the edge around one of the four middle texels: `c` between `a` above, `b` left, `d` right and `e` below.
    fn add(&mut self, weight: f32, a: f32, b: f32, c: f32, d: f32, e: f32) {
        let (x, share) = Edge::along(b, c, d);
        self.direction.x += x * weight;
        self.length += share * weight;
        let (y, share) = Edge::along(a, c, e);
        self.direction.y += y * weight;
        self.length += share * weight;
    }

    /// Gradient in one direction, and the share of the contrast that is monotonic.
    fn along(before: f32, here: f32, after: f32) -> (f32, f32) {
        let contrast = (after - here).abs().max((here - before).abs());
        let gradient = after - before;
        // Avoids 0 / 0 in flat areas.
        let share = if contrast > 0.0 {
            saturate(gradient.abs() / contrast)
        } else {
            0.0
        };
        (gradient, share * share)
    }
}

/// Weighted sum of the taps.
struct Sum {
    color: Vec3,
    weight: f32,
}

fn tap(sum: &mut Sum, offset: Vec2, direction: Vec2, stretch: Vec2, lobe: f32, clip: f32, color: Vec3) {
    let turned = vec2(offset.dot(direction), offset.dot(vec2(-direction.y, direction.x)));
    let distance = (turned * stretch).length_squared().min(clip);
    let base = 2.0 / 5.0 * distance - 1.0;
    let window = lobe * distance - 1.0;
    let weight = (25.0 / 16.0 * base * base - (25.0 / 16.0 - 1.0)) * window * window;
    sum.color += color * weight;
    sum.weight += weight;
}

pub fn easu(image: &Texture<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let at = (pixel.as_vec2() + 0.5) * image.size().as_vec2() / resolution.as_vec2() - 0.5;
    let corner = at.floor();
    let part = at - corner;
    let load = |x, y| image.load(corner.as_ivec2() + ivec2(x, y)).truncate();

    let (b, c) = (load(0, -1), load(1, -1));
    let (e, f, g, h) = (load(-1, 0), load(0, 0), load(1, 0), load(2, 0));
    let (i, j, k, l) = (load(-1, 1), load(0, 1), load(1, 1), load(2, 1));
    let (n, o) = (load(0, 2), load(1, 2));
    let (bl, cl) = (luma(b), luma(c));
    let (el, fl, gl, hl) = (luma(e), luma(f), luma(g), luma(h));
    let (il, jl, kl, ll) = (luma(i), luma(j), luma(k), luma(l));
    let (nl, ol) = (luma(n), luma(o));

    let mut edge = Edge {
        direction: Vec2::ZERO,
        length: 0.0,
    };
    edge.add((1.0 - part.x) * (1.0 - part.y), bl, el, fl, gl, jl);
    edge.add(part.x * (1.0 - part.y), cl, fl, gl, hl, kl);
    edge.add((1.0 - part.x) * part.y, fl, il, jl, kl, nl);
    edge.add(part.x * part.y, gl, jl, kl, ll, ol);

    let steepness = edge.direction.length_squared();
    let direction = if steepness < 1.0 / 32768.0 {
        Vec2::X
    } else {
        edge.direction * inverse_sqrt(steepness)
    };
    let amount = 0.5 * edge.length;
    let amount = amount * amount;
    // Stretches a round kernel along edges, diagonal ones included.
    let diagonal = direction.length_squared() / direction.x.abs().max(direction.y.abs());
    let stretch = vec2(1.0 + (diagonal - 1.0) * amount, 1.0 - 0.5 * amount);
    let lobe = 0.5 + ((1.0 / 4.0 - 0.04) - 0.5) * amount;
    let clip = 1.0 / lobe;

    let mut sum = Sum {
        color: Vec3::ZERO,
        weight: 0.0,
    };
    let mut add = |x: f32, y: f32, color: Vec3| tap(&mut sum, vec2(x, y) - part, direction, stretch, lobe, clip, color);
    add(0.0, -1.0, b);
    add(1.0, -1.0, c);
    add(-1.0, 1.0, i);
    add(0.0, 1.0, j);
    add(0.0, 0.0, f);
    add(-1.0, 0.0, e);
    add(1.0, 1.0, k);
    add(2.0, 1.0, l);
    add(2.0, 0.0, h);
    add(1.0, 0.0, g);
    add(1.0, 2.0, o);
    add(0.0, 2.0, n);
    // Clamped to the nearest texels, against ringing.
    let least = f.min(g).min(j).min(k);
    let most = f.max(g).max(j).max(k);
    (sum.color / sum.weight).max(least).min(most).extend(1.0)
}
