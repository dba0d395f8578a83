//! The house: a grooved wall with windows and a door under a tiled gable roof.

use super::{hash_noise, paint};
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::FRAC_PI_2;

/// The walls' outside, seen from above: x to each side of 0, z of the front and of the back.
const HALF_WIDTH: f32 = 4.0;
const FRONT: f32 = 0.0;
const BACK: f32 = -6.0;
/// Height of the eaves and of the ridge, which runs along x in the middle.
const EAVES: f32 = 3.9;
const RIDGE: f32 = 6.1;
/// Height of what the walls stand on.
const PLINTH: f32 = 0.42;
/// Lower edges of the windows in either gable wall: how far right of its middle, and how high.
const GABLE_WINDOWS: [[f32; 2]; 4] = [[-1.3, 0.95], [1.3, 0.95], [-1.3, 2.55], [1.3, 2.55]];
/// Distance by which the roof reaches beyond the walls.
const OVERHANG: f32 = 0.45;

pub(super) fn add(mesh: &mut Mesh) {
    add_walls(mesh);
    for (x, y) in [(-2.75, 0.95), (-0.55, 0.95), (-2.75, 2.55), (-0.55, 2.55), (1.9, 2.55)] {
        mesh.add_at(Affine3A::from_translation(vec3(x, y, FRONT)), add_window);
    }
    mesh.add_at(Affine3A::from_translation(vec3(1.9, 0.0, FRONT)), add_door);
    add_roof(mesh);
    add_chimney(mesh);
}

/// The core behind the walls' stones, with the plinth and the gables.
fn add_walls(mesh: &mut Mesh) {
    let inset = vec3(0.12, 0.0, 0.12);
    let (min, max) = (vec3(-HALF_WIDTH, 0.0, BACK), vec3(HALF_WIDTH, EAVES, FRONT));
    mesh.add_block(min + inset, max - inset, paint::PLASTER * 0.55);
    let out = vec3(0.08, 0.0, 0.08);
    mesh.add_block(min - out, vec3(max.x, PLINTH, max.z) + out, paint::STONE);
    let windows = [-2.75, -0.55, 1.9].map(|x| [x, 2.55, 3.65]);
    let lower = [[-2.75, 0.95, 2.05], [-0.55, 0.95, 2.05], [1.9, 0.0, 2.25]];
    add_wall(mesh, HALF_WIDTH, &[windows, lower].concat());
    let half = 0.5 * (FRONT - BACK);
    for side in [-1.0, 1.0] {
        let turn = Affine3A::from_rotation_y(side * FRAC_PI_2);
        let place = Affine3A::from_translation(vec3(side * HALF_WIDTH, 0.0, -half)) * turn;
        mesh.add_at(place, |mesh| {
            add_wall(mesh, half, &GABLE_WINDOWS.map(|[x, y]| [x, y, y + 1.1]));
            for [x, y] in GABLE_WINDOWS {
                mesh.add_at(Affine3A::from_translation(vec3(x, y, 0.0)), add_window);
            }
            add_gable(mesh, half);
        });
    }
}

/// Boards from the eaves up to the slopes of the roof, with grooves between.
fn add_gable(mesh: &mut Mesh, half: f32) {
    const BOARDS: u32 = 20;
    let width = 2.0 * half / BOARDS as f32;
    let slope = |x: f32| RIDGE - 0.1 - (RIDGE - EAVES) * x.abs() / half;
    for board in 0..BOARDS {
        let left = -half + width * board as f32 + 0.015;
        let right = left + width - 0.03;
        let foot = [(left, 0.0), (right, 0.0), (right, -0.2), (left, -0.2)];
        let lower = foot.map(|(x, z)| vec3(x, EAVES - 0.02, z));
        let upper = foot.map(|(x, z)| vec3(x, slope(x), z));
        mesh.add_hexahedron([lower, upper], paint::BOARD * (0.9 + 0.2 * hash_noise(3000 + board)));
    }
    let edge = [
        vec3(-half, EAVES, -0.06),
        vec3(half, EAVES, -0.06),
        vec3(0.0, RIDGE - 0.1, -0.06),
    ];
    mesh.add_polygon(&edge, paint::BOARD * 0.5);
}

/// A wall in the plane of z, `half` to both sides: courses of stones with grooves between, left open where
/// `openings` are, each a metre wide: its middle, its lower and its upper edge.
fn add_wall(mesh: &mut Mesh, half: f32, openings: &[[f32; 3]]) {
    const COURSE: f32 = 0.29;
    const GROOVE: f32 = 0.045;
    let mut course = 0;
    let mut y = PLINTH;
    while y < EAVES - 0.05 {
        let top = (y + COURSE - GROOVE).min(EAVES);
        // Walk along the course, from opening to opening.
        let inside = openings.iter().filter(|[_, low, high]| *low < top && *high > y);
        let mut open: Vec<[f32; 2]> = inside.map(|[x, _, _]| [x - 0.5, x + 0.5]).collect();
        open.sort_by(|a, b| a[0].total_cmp(&b[0]));
        open.push([half, half]);
        let mut from = -half;
        for [left, right] in open {
            add_stones(mesh, course, [from, left], [y, top]);
            from = right;
        }
        course += 1;
        y += COURSE;
    }
}

/// Stones of one course between two openings.
fn add_stones(mesh: &mut Mesh, course: u32, [from, to]: [f32; 2], [low, high]: [f32; 2]) {
    const LENGTH: f32 = 1.1;
    let shift = if course.is_multiple_of(2) { 0.0 } else { 0.5 * LENGTH };
    let mut x = ((from - shift) / LENGTH).floor() * LENGTH + shift;
    while x < to {
        let (left, right) = (x.max(from), (x + LENGTH - 0.04).min(to));
        if right - left > 0.02 {
            let seed = course * 64 + (x + 16.0) as u32;
            let tint = paint::PLASTER * (0.92 + 0.14 * hash_noise(seed));
            mesh.add_block(vec3(left, low, -0.2), vec3(right, high, 0.0), tint);
        }
        x += LENGTH;
    }
}

/// A window 1.0 wide and 1.1 high, with its lower edge in the middle of where it is placed.
fn add_window(mesh: &mut Mesh) {
    mesh.add_polygon(
        &[
            vec3(-0.5, 0.0, -0.1),
            vec3(0.5, 0.0, -0.1),
            vec3(0.5, 1.1, -0.1),
            vec3(-0.5, 1.1, -0.1),
        ],
        paint::GLASS,
    );
    add_frame(mesh, [-0.5, 0.5], [0.0, 1.1], 0.06, -0.02);
    for i in 1..4 {
        let x = -0.5 + 0.25 * i as f32;
        mesh.add_block(vec3(x - 0.012, 0.0, -0.1), vec3(x + 0.012, 1.1, -0.055), paint::TRIM);
    }
    for y in [0.37, 0.73] {
        mesh.add_block(vec3(-0.5, y - 0.012, -0.1), vec3(0.5, y + 0.012, -0.06), paint::TRIM);
    }
    // The sill, and a lintel that leans forward.
    mesh.add_block(vec3(-0.6, -0.07, -0.1), vec3(0.6, 0.0, 0.13), paint::TRIM);
    let lintel = |y: f32, z: f32| {
        [
            vec3(-0.62, y, z),
            vec3(0.62, y, z),
            vec3(0.62, y, -0.1),
            vec3(-0.62, y, -0.1),
        ]
    };
    mesh.add_hexahedron([lintel(1.1, 0.05), lintel(1.22, 0.12)], paint::TRIM);
    // Louvred shutters.
    for side in [-1.0, 1.0] {
        let place = Affine3A::from_translation(vec3(0.74 * side, 0.0, 0.0));
        mesh.add_at(place, |mesh| {
            add_frame(mesh, [-0.2, 0.2], [-0.02, 1.1], 0.045, 0.06);
            for i in 0..13 {
                let y = 0.05 + 0.08 * i as f32;
                let slat = [
                    vec3(-0.16, y, 0.045),
                    vec3(0.16, y, 0.045),
                    vec3(0.16, y + 0.07, 0.005),
                    vec3(-0.16, y + 0.07, 0.005),
                ];
                mesh.add_polygon(&slat, paint::DOOR * 1.15);
            }
        });
    }
}

/// Four laths around an opening in the plane of z, `depth` in front of it at most.
fn add_frame(mesh: &mut Mesh, [left, right]: [f32; 2], [low, high]: [f32; 2], width: f32, z: f32) {
    let color = if z > 0.0 { paint::DOOR } else { paint::TRIM };
    let back = z - 0.06;
    mesh.add_block(vec3(left, low, back), vec3(left + width, high, z), color);
    mesh.add_block(vec3(right - width, low, back), vec3(right, high, z), color);
    mesh.add_block(vec3(left, low, back), vec3(right, low + width, z), color);
    mesh.add_block(vec3(left, high - width, back), vec3(right, high, z), color);
}

/// A door 1.0 wide and 2.25 high with raised panels and a canopy on struts.
fn add_door(mesh: &mut Mesh) {
    mesh.add_block(vec3(-0.5, 0.0, -0.15), vec3(0.5, 2.25, -0.08), paint::DOOR);
    for (x, low, high) in [
        (-0.24, 0.2, 0.9),
        (0.24, 0.2, 0.9),
        (-0.24, 1.05, 2.1),
        (0.24, 1.05, 2.1),
    ] {
        mesh.add_block(
            vec3(x - 0.17, low, -0.1),
            vec3(x + 0.17, high, -0.045),
            paint::DOOR * 1.5,
        );
    }
    add_frame(mesh, [-0.58, 0.58], [0.0, 2.31], 0.08, -0.0);
    let canopy = |rise: f32| {
        [
            vec3(-0.85, 2.38 + rise, 0.75),
            vec3(0.85, 2.38 + rise, 0.75),
            vec3(0.85, 2.62 + rise, 0.0),
            vec3(-0.85, 2.62 + rise, 0.0),
        ]
    };
    mesh.add_hexahedron([canopy(0.0), canopy(0.05)], paint::TIMBER);
    for x in [-0.75, 0.75] {
        mesh.add_bar(vec3(x, 1.95, 0.0), vec3(x, 2.42, 0.66), 0.018, 6, paint::IRON);
    }
}

/// Two slopes of overlapping tiles, a ridge, barge boards and gutters.
fn add_roof(mesh: &mut Mesh) {
    let middle = 0.5 * (FRONT + BACK);
    let reach = HALF_WIDTH + OVERHANG;
    for (side, edge) in [(1.0, FRONT), (-1.0, BACK)] {
        let fall = vec3(0.0, EAVES - RIDGE, edge - middle);
        // Past the wall by the overhang, along the slope.
        let low = vec3(0.0, RIDGE, middle) + fall * (1.0 + OVERHANG / fall.z.abs());
        add_slope(mesh, vec3(0.0, RIDGE, middle), low, reach, side);
        for x in [-reach, reach] {
            let board = |z: f32| vec3(x, 0.0, 0.0) + vec3(0.0, z, 0.0);
            let (a, b) = (board(-0.10) + low, board(-0.10) + vec3(0.0, RIDGE, middle));
            mesh.add_bar(a, b, 0.07, 4, paint::TRIM);
        }
        // The gutter, and its pipe down the wall.
        let gutter = low + vec3(0.0, -0.05, 0.06 * side);
        let half = Vec3::X * (reach - 0.05);
        mesh.add_frustum(
            [(gutter - half, 0.055), (gutter + half, 0.055)],
            10,
            paint::IRON * 2.0,
            true,
        );
        let pipe = vec3(HALF_WIDTH - 0.25, 0.0, edge + 0.06 * side);
        mesh.add_bar(
            gutter + Vec3::X * (HALF_WIDTH - 0.25),
            pipe + Vec3::Y * 3.4,
            0.03,
            8,
            paint::IRON * 2.0,
        );
        mesh.add_bar(pipe + Vec3::Y * 3.4, pipe, 0.03, 8, paint::IRON * 2.0);
    }
    let ridge = vec3(0.0, RIDGE + 0.04, middle);
    let half = Vec3::X * (reach + 0.02);
    mesh.add_frustum(
        [(ridge - half, 0.11), (ridge + half, 0.11)],
        6,
        vec3(0.36, 0.11, 0.06),
        false,
    );
}

/// A slope from its upper to its lower edge, `reach` to both sides: rows of tiles, each over the next lower one.
fn add_slope(mesh: &mut Mesh, top: Vec3, low: Vec3, reach: f32, side: f32) {
    const ROWS: u32 = 13;
    const COLUMNS: u32 = 40;
    let along = (low - top) / ROWS as f32;
    let up = Vec3::X.cross(along).normalize() * -side;
    let up = if up.y > 0.0 { up } else { -up };
    let width = 2.0 * reach / COLUMNS as f32;
    for row in 0..ROWS {
        let from = top + along * row as f32;
        let to = from + along * 1.12;
        for column in 0..COLUMNS {
            let x = -reach + width * column as f32;
            let tint = 0.72 + 0.5 * hash_noise(row * COLUMNS + column + if side > 0.0 { 0 } else { 7919 });
            let color = vec3(0.44, 0.135, 0.07) * tint;
            // Lower edges lie on the next row; a gap to the neighbour shows the row below.
            let (left, right) = (Vec3::X * (x + 0.006), Vec3::X * (x + width - 0.006));
            let face = |point: Vec3, rise: f32| point + up * rise;
            let (a, b) = (face(to, 0.035), face(to, 0.085));
            let (c, d) = (face(from, -0.02), face(from, 0.03));
            let lower = if side > 0.0 {
                [a + left, a + right, c + right, c + left]
            } else {
                [a + right, a + left, c + left, c + right]
            };
            let upper = if side > 0.0 {
                [b + left, b + right, d + right, d + left]
            } else {
                [b + right, b + left, d + left, d + right]
            };
            mesh.add_hexahedron([lower, upper], color);
        }
    }
}

/// A chimney with a pot and a cap.
fn add_chimney(mesh: &mut Mesh) {
    let color = vec3(0.33, 0.12, 0.075);
    for course in 0..9 {
        let y = 5.0 + 0.2 * course as f32;
        let tint = color * (0.85 + 0.35 * hash_noise(900 + course));
        mesh.add_block(vec3(-2.75, y, -2.3), vec3(-2.05, y + 0.17, -1.7), tint);
    }
    mesh.add_block(vec3(-2.72, 5.0, -2.27), vec3(-2.08, 6.75, -1.73), color * 0.5);
    mesh.add_block(vec3(-2.85, 6.78, -2.4), vec3(-1.95, 6.9, -1.6), paint::STONE);
    for x in [-2.58, -2.22] {
        mesh.add_frustum(
            [(vec3(x, 6.9, -2.0), 0.13), (vec3(x, 7.25, -2.0), 0.10)],
            12,
            color * 1.3,
            true,
        );
    }
}
