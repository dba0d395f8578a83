//! Solids of the scene, and their intersections with rays.

use glam::{Vec3, vec3};

/// Intersection of a ray with a solid.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// In lengths of the ray's direction.
    pub distance: f32,
    /// Unit normal, outwards.
    pub normal: Vec3,
    /// Material of the solid.
    pub material: Material,
}

/// Material of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// The tiled ground.
    Tiles,
    /// A wall with windows.
    Wall,
    /// A colour, and the strength of its highlights.
    Plain(Vec3, f32),
}

enum Shape {
    Sphere(Vec3, f32),
    /// Centre, half its size, and sine and cosine of its turn about the vertical.
    Block(Vec3, Vec3, [f32; 2]),
    /// From, to, radius.
    Wire(Vec3, Vec3, f32),
}

struct Solid {
    shape: Shape,
    material: Material,
}

const fn plain_material(r: f32, g: f32, b: f32, shine: f32) -> Material {
    Material::Plain(vec3(r, g, b), shine)
}

const fn sphere(centre: Vec3, radius: f32, material: Material) -> Solid {
    Solid {
        shape: Shape::Sphere(centre, radius),
        material,
    }
}

const fn block(centre: Vec3, half: Vec3, turn: [f32; 2], material: Material) -> Solid {
    Solid {
        shape: Shape::Block(centre, half, turn),
        material,
    }
}

const fn wire(from: Vec3, to: Vec3, radius: f32) -> Solid {
    Solid {
        shape: Shape::Wire(from, to, radius),
        material: plain_material(0.04, 0.04, 0.05, 0.1),
    }
}

const STRAIGHT: [f32; 2] = [0.0, 1.0];
const TURNED: [f32; 2] = [0.479_425_5, 0.877_582_6];
const ASKEW: [f32; 2] = [-0.644_217_7, 0.764_842_2];
const WOOD: Material = plain_material(0.55, 0.50, 0.42, 0.05);

const SOLIDS: [Solid; 12] = [
    sphere(vec3(-1.45, 0.8, 0.6), 0.8, plain_material(0.62, 0.06, 0.04, 0.6)),
    sphere(vec3(0.15, 0.5, -0.35), 0.5, plain_material(0.80, 0.48, 0.10, 0.8)),
    sphere(vec3(-0.55, 0.28, -1.15), 0.28, plain_material(0.04, 0.36, 0.38, 0.5)),
    block(
        vec3(1.75, 0.7, 0.9),
        vec3(0.62, 0.7, 0.62),
        TURNED,
        plain_material(0.16, 0.26, 0.52, 0.1),
    ),
    block(
        vec3(1.8, 1.68, 0.95),
        vec3(0.36, 0.28, 0.36),
        ASKEW,
        plain_material(0.70, 0.66, 0.58, 0.1),
    ),
    block(vec3(-3.4, 1.9, 6.0), vec3(0.9, 1.9, 0.9), TURNED, Material::Wall),
    block(vec3(3.9, 1.3, 7.0), vec3(1.3, 1.3, 0.9), ASKEW, Material::Wall),
    block(vec3(0.0, 0.92, 3.2), vec3(5.2, 0.03, 0.02), STRAIGHT, WOOD),
    block(vec3(0.0, 0.34, 3.2), vec3(5.2, 0.03, 0.02), STRAIGHT, WOOD),
    wire(vec3(-6.0, 3.5, 5.0), vec3(6.0, 2.5, 4.0), 0.012),
    wire(vec3(-6.0, 3.1, 5.0), vec3(6.0, 2.2, 4.0), 0.012),
    wire(vec3(-0.9, 0.0, -1.6), vec3(2.6, 2.3, 0.2), 0.016),
];

/// Bars of the fence: their distance, and half their size.
const BAR_STEP: f32 = 0.32;
const BAR: Vec3 = vec3(0.025, 0.62, 0.025);
const FENCE: Vec3 = vec3(0.0, 0.62, 3.12);
const BARS: i32 = 16;

/// The first thing that a ray meets within a distance.
pub fn first_hit(from: Vec3, direction: Vec3, farthest: f32) -> Option<Hit> {
    let mut nearest: Option<Hit> = None;
    let mut offer = |found: Option<(f32, Vec3)>, material: Material| {
        if let Some((distance, normal)) = found
            && distance < nearest.map_or(farthest, |hit| hit.distance)
        {
            nearest = Some(Hit {
                distance,
                normal,
                material,
            });
        }
    };
    if direction.y < 0.0 {
        offer(Some((-from.y / direction.y, Vec3::Y)), Material::Tiles);
    }
    for solid in &SOLIDS {
        let found = match &solid.shape {
            Shape::Sphere(centre, radius) => on_sphere(from - *centre, direction, *radius),
            Shape::Block(centre, half, turn) => match misses_block(from - *centre, direction, *half) {
                true => None,
                false => on_block(from - *centre, direction, *half, *turn),
            },
            Shape::Wire(start, end, radius) => on_wire(from, direction, *start, *end, *radius),
        };
        offer(found, solid.material);
    }
    let all = vec3(BARS as f32 * BAR_STEP + BAR.x, BAR.y, BAR.z);
    if let Some((distance, _)) = on_block(from - FENCE, direction, all, STRAIGHT) {
        // The fence is thin: a ray that enters it meets the nearest bar, one of those beside it, or none.
        let across = (from.x + direction.x * distance - FENCE.x) / BAR_STEP;
        for k in [-1.0, 0.0, 1.0] {
            let index = across.round() + k;
            let bar = FENCE + vec3(index * BAR_STEP, 0.0, 0.0);
            if index.abs() <= BARS as f32 && !misses_block(from - bar, direction, BAR) {
                offer(on_block(from - bar, direction, BAR, STRAIGHT), WOOD);
            }
        }
    }
    nearest
}

/// Returns whether a ray misses the sphere around a block, a quick test.
fn misses_block(from: Vec3, direction: Vec3, half: Vec3) -> bool {
    let (a, b) = (direction.length_squared(), from.dot(direction));
    b * b < a * (from.length_squared() - half.length_squared())
}

/// Nothing nearer than this is met: a ray that begins on a surface leaves it.
const LEAST: f32 = 1.0e-3;

fn on_sphere(from: Vec3, direction: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let (a, b) = (direction.length_squared(), from.dot(direction));
    let root = (b * b - a * (from.length_squared() - radius * radius)).max(-1.0);
    let distance = (-b - root.sqrt()) / a;
    (root >= 0.0 && distance > LEAST).then(|| (distance, (from + direction * distance) / radius))
}

fn on_block(from: Vec3, direction: Vec3, half: Vec3, [sine, cosine]: [f32; 2]) -> Option<(f32, Vec3)> {
    let turned = |v: Vec3| vec3(cosine * v.x - sine * v.z, v.y, sine * v.x + cosine * v.z);
    let (from, direction) = (turned(from), turned(direction));
    let inverse = direction.recip();
    let (near, far) = (
        (-half * direction.signum() - from) * inverse,
        (half * direction.signum() - from) * inverse,
    );
    let distance = near.max_element();
    if distance > far.min_element() || distance <= LEAST {
        return None;
    }
    let axis = near.max_position();
    let mut normal = Vec3::ZERO;
    normal[axis] = -direction[axis].signum();
    // Back, by the turn the other way.
    let normal = vec3(
        cosine * normal.x + sine * normal.z,
        normal.y,
        cosine * normal.z - sine * normal.x,
    );
    Some((distance, normal))
}

/// A cylinder without ends.
fn on_wire(from: Vec3, direction: Vec3, start: Vec3, end: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let along = end - start;
    let square = along.length_squared();
    let across = |v: Vec3| v - along * (v.dot(along) / square);
    let (offset, sideways) = (across(from - start), across(direction));
    let (a, b) = (sideways.length_squared(), offset.dot(sideways));
    let root = b * b - a * (offset.length_squared() - radius * radius);
    if root < 0.0 {
        return None;
    }
    let distance = (-b - root.sqrt()) / a;
    let share = (from + direction * distance - start).dot(along) / square;
    // A wire is thin and far away: what is left of large numbers is no longer exactly as long as its radius.
    let normal = (offset + sideways * distance).normalize_or(-direction.normalize());
    (distance > LEAST && (0.0..=1.0).contains(&share)).then_some((distance, normal))
}
