//! Unit normals in fewer bits.

/// Encoding of a stored unit normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalEncoding {
    /// Three floats.
    Float,
    /// Eight bits each of ½n + ½, as the paper's listing reads them; made a unit vector again.
    Rgb8,
    /// On an octahedron unfolded into a square (Cigolle et al. 2014), eight bits on each axis.
    Octahedral8,
    /// On the unfolded octahedron, sixteen bits on each axis.
    Octahedral16,
    /// Ten bits each of ½n + ½; made a unit vector again.
    Rgb10A2,
}

impl NormalEncoding {
    /// The components of the texel: floats as they are, unorms as the 0 to 1 that a shader reads. An octahedral one has
    /// two, and 0. Of no normal, 0, as where nothing is drawn, every component is 0: as renderers clear them.
    pub fn encode(self, normal: [f64; 3]) -> [f64; 3] {
        if normal == [0.0; 3] {
            return normal;
        }
        match self {
            NormalEncoding::Float => normal.map(|c| f64::from(c as f32)),
            NormalEncoding::Rgb8 => normal.map(|c| round_to_unorm(0.5 * c + 0.5, 8)),
            NormalEncoding::Rgb10A2 => normal.map(|c| round_to_unorm(0.5 * c + 0.5, 10)),
            NormalEncoding::Octahedral8 => encode_octahedral(normal, 8),
            NormalEncoding::Octahedral16 => encode_octahedral(normal, 16),
        }
    }

    /// The unit normal that a texel stands for.
    pub fn decode(self, texel: [f64; 3]) -> [f64; 3] {
        let signed = texel.map(|c| 2.0 * c - 1.0);
        match self {
            NormalEncoding::Float => texel,
            NormalEncoding::Rgb8 | NormalEncoding::Rgb10A2 => unit(signed),
            NormalEncoding::Octahedral8 | NormalEncoding::Octahedral16 => {
                let [x, y, _] = signed;
                let z = 1.0 - x.abs() - y.abs();
                let [x, y] = if z < 0.0 { mirror_at_diagonal(x, y) } else { [x, y] };
                unit([x, y, z])
            }
        }
    }
}

fn encode_octahedral(normal: [f64; 3], bits: u32) -> [f64; 3] {
    let [x, y] = unfold_octahedron(normal);
    [
        round_to_unorm(0.5 * x + 0.5, bits),
        round_to_unorm(0.5 * y + 0.5, bits),
        0.0,
    ]
}

/// Onto the octahedron |x| + |y| + |z| = 1, its lower half folded out to the corners of the square from -1 to 1.
pub(super) fn unfold_octahedron([x, y, z]: [f64; 3]) -> [f64; 2] {
    let size = x.abs() + y.abs() + z.abs();
    if size == 0.0 {
        return [0.0; 2];
    }
    let [x, y] = [x / size, y / size];
    if z < 0.0 { mirror_at_diagonal(x, y) } else { [x, y] }
}

/// Mirrored at the diagonal of its quadrant; 0 counts as above 0. The same in both directions.
fn mirror_at_diagonal(x: f64, y: f64) -> [f64; 2] {
    let sign = |c: f64| if c < 0.0 { -1.0 } else { 1.0 };
    [(1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y)]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// The nearest of the numbers from 0 to 1 that `bits` bits hold.
pub(super) fn round_to_unorm(value: f64, bits: u32) -> f64 {
    let most = f64::from((1u32 << bits) - 1);
    (value.clamp(0.0, 1.0) * most).round() / most
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unit vectors all over the sphere, with the axes, and those where signs and halves change.
    fn normals() -> Vec<[f64; 3]> {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let mut all: Vec<[f64; 3]> = (0..40_000)
            .map(|k| {
                let z = 1.0 - (2.0 * f64::from(k) + 1.0) / 40_000.0;
                let (radius, angle) = ((1.0 - z * z).sqrt(), golden * f64::from(k));
                [radius * angle.cos(), radius * angle.sin(), z]
            })
            .collect();
        for x in -1..=1 {
            for y in -1..=1 {
                for z in -1..=1 {
                    for tiny in [0.0, 1.0e-9, -1.0e-9] {
                        let v = [f64::from(x) + tiny, f64::from(y) - tiny, f64::from(z) + 2.0 * tiny];
                        if (x, y, z) != (0, 0, 0) {
                            all.push(unit(v));
                        }
                    }
                }
            }
        }
        all
    }

    /// The angle between two unit vectors in degrees, exact for small ones.
    fn angle_degrees(a: [f64; 3], b: [f64; 3]) -> f64 {
        let chord = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        (2.0 * (0.5 * chord).asin()).to_degrees()
    }

    #[test]
    fn what_is_encoded_is_decoded_within_its_bits() {
        // Most degrees off; for RGB half a step along the diagonal, for octahedra as measured by Cigolle et al.
        for (encoding, most, components) in [
            (NormalEncoding::Float, 1.0e-5, 3),
            (NormalEncoding::Rgb8, 0.3892, 3),
            (NormalEncoding::Rgb10A2, 0.0971, 3),
            (NormalEncoding::Octahedral8, 0.9546, 2),
            (NormalEncoding::Octahedral16, 0.0038, 2),
        ] {
            let mut worst = 0.0f64;
            for normal in normals() {
                let texel = encoding.encode(normal);
                let back = encoding.decode(texel);
                worst = worst.max(angle_degrees(normal, back));
                let length = back.iter().map(|c| c * c).sum::<f64>().sqrt();
                assert!(
                    (length - 1.0).abs() < 1.0e-6,
                    "{encoding:?}: {normal:?} came back as {back:?}"
                );
                assert!(components == 3 || texel[2] == 0.0, "{encoding:?}: {texel:?}");
                if encoding != NormalEncoding::Float {
                    assert!(texel.iter().all(|c| (0.0..=1.0).contains(c)), "{encoding:?}: {texel:?}");
                }
            }
            assert!(
                worst <= most && worst > 0.4 * most * f64::from(u8::from(most > 1.0e-4)),
                "{encoding:?}: {worst} degrees"
            );
        }
    }

    /// A decoded normal is encoded as the same numbers again, except where two texels mean one normal: at the folded
    /// octahedron's rim.
    #[test]
    fn a_decoded_normal_is_encoded_as_before() {
        for (encoding, top) in [
            (NormalEncoding::Octahedral8, 255),
            (NormalEncoding::Octahedral16, 65535),
        ] {
            for k in 0..5000u64 {
                let pick = |salt: u64| (k * 2_654_435_761 + salt * 40_503) % (top + 1);
                let texel = [pick(1) as f64 / top as f64, pick(7) as f64 / top as f64, 0.0];
                let again = encoding.encode(encoding.decode(texel));
                let rim = texel[..2].iter().any(|c| *c == 0.0 || *c == 1.0);
                assert!(
                    rim || (0..2).all(|i| (again[i] - texel[i]).abs() < 1.0e-12),
                    "{encoding:?}: {texel:?}, {again:?}"
                );
            }
        }
    }
}
