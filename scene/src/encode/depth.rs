//! Depth in the forms that projections give it.

/// Encoding of stored depth. `near` and `far` are linear depths, 0 < `near` < `far`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepthEncoding {
    /// As it is: distance along the view direction.
    Linear,
    /// A perspective projection's z/w: 0 at `near`, 1 at `far`.
    Perspective {
        /// Linear depth of 0.
        near: f64,
        /// Linear depth of 1.
        far: f64,
    },
    /// A perspective projection's z/w reversed: 1 at `near`, 0 at `far`.
    Reversed {
        /// Linear depth of 1.
        near: f64,
        /// Linear depth of 0.
        far: f64,
    },
    /// Reversed with `far` at infinity: `near` / depth.
    InfiniteReversed {
        /// Linear depth of 1.
        near: f64,
    },
    /// A parallel projection's: 0 at `near`, 1 at `far`, in even steps.
    Parallel {
        /// Linear depth of 0.
        near: f64,
        /// Linear depth of 1.
        far: f64,
    },
    /// Reversed depth of a parallel projection: 1 at `near`, 0 at `far`.
    ParallelReversed {
        /// Linear depth of 1.
        near: f64,
        /// Linear depth of 0.
        far: f64,
    },
}

/// In how many bits a number is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthStorage {
    /// `r32float`.
    Float32,
    /// 24 bits of 0 to 1, as in `depth24plus` on most hardware.
    Unorm24,
    /// 16 bits of 0 to 1, `depth16unorm`.
    Unorm16,
}

impl DepthEncoding {
    /// Returns the number that is stored for a linear depth above 0. All but linear depth is kept in 0..=1: depths nearer than
    /// `near` or farther than `far`, such as the sky's, are clamped to these.
    pub fn encode(self, depth: f64) -> f64 {
        match self {
            DepthEncoding::Linear => depth,
            DepthEncoding::Perspective { near, far } => (far * (depth - near) / (depth * (far - near))).clamp(0.0, 1.0),
            DepthEncoding::Reversed { near, far } => (near * (far - depth) / (depth * (far - near))).clamp(0.0, 1.0),
            DepthEncoding::InfiniteReversed { near } => (near / depth).clamp(0.0, 1.0),
            DepthEncoding::Parallel { near, far } => ((depth - near) / (far - near)).clamp(0.0, 1.0),
            DepthEncoding::ParallelReversed { near, far } => ((far - depth) / (far - near)).clamp(0.0, 1.0),
        }
    }

    /// The linear depth that a stored number stands for. With [`InfiniteReversed`](Self::InfiniteReversed), 0 is
    /// infinitely far.
    pub fn decode(self, stored: f64) -> f64 {
        match self {
            DepthEncoding::Linear => stored,
            DepthEncoding::Perspective { near, far } => near * far / (far - stored * (far - near)),
            DepthEncoding::Reversed { near, far } => near * far / (near + stored * (far - near)),
            DepthEncoding::InfiniteReversed { near } => near / stored,
            DepthEncoding::Parallel { near, far } => near + stored * (far - near),
            DepthEncoding::ParallelReversed { near, far } => far - stored * (far - near),
        }
    }
}

impl DepthStorage {
    /// `value` as it comes back from storage. Unorms keep 0 to 1, in even steps.
    pub fn round(self, value: f64) -> f64 {
        match self {
            DepthStorage::Float32 => f64::from(value as f32),
            DepthStorage::Unorm24 => super::normal::round_to_unorm(value, 24),
            DepthStorage::Unorm16 => super::normal::round_to_unorm(value, 16),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: f64 = 0.1;
    const FAR: f64 = 500.0;

    fn all_encodings() -> [DepthEncoding; 4] {
        [
            DepthEncoding::Linear,
            DepthEncoding::Perspective { near: NEAR, far: FAR },
            DepthEncoding::Reversed { near: NEAR, far: FAR },
            DepthEncoding::InfiniteReversed { near: NEAR },
        ]
    }

    /// Depths from near to far, each a little farther than the last.
    fn depths() -> impl Iterator<Item = f64> {
        (0..=2000).map(|k| NEAR * (FAR / NEAR).powf(f64::from(k) / 2000.0))
    }

    #[test]
    fn what_is_encoded_is_decoded() {
        for encoding in all_encodings() {
            for depth in depths() {
                let back = encoding.decode(encoding.encode(depth));
                // Perspective loses as much near 1 in double precision.
                assert!(
                    (back / depth - 1.0).abs() < 1.0e-11,
                    "{encoding:?}: {depth} came back as {back}"
                );
            }
        }
    }

    #[test]
    fn ends_and_order() {
        let [_, perspective, reversed, infinite] = all_encodings();
        assert_eq!([perspective.encode(NEAR), perspective.encode(FAR)], [0.0, 1.0]);
        assert_eq!([reversed.encode(NEAR), reversed.encode(FAR)], [1.0, 0.0]);
        assert_eq!((infinite.encode(NEAR), infinite.decode(0.0)), (1.0, f64::INFINITY));
        // The sky, far beyond.
        for encoding in [perspective, reversed] {
            assert!((encoding.decode(encoding.encode(1.0e6)) / FAR - 1.0).abs() < 1.0e-11);
        }
        let pairs: Vec<[f64; 2]> = depths().zip(depths().skip(1)).map(|(a, b)| [a, b]).collect();
        for [a, b] in pairs {
            assert!(perspective.encode(a) < perspective.encode(b));
            assert!(reversed.encode(a) > reversed.encode(b) && infinite.encode(a) > infinite.encode(b));
            assert!((perspective.encode(a) + reversed.encode(a) - 1.0).abs() < 1.0e-12);
        }
    }

    /// The projection of a scene's camera is the infinite reversed one.
    #[test]
    fn infinite_reversed_depth_is_what_the_camera_projects_to() {
        let camera = crate::scene::Scene::from_name("roof").expect("a scene").camera;
        let projection = camera.projection(glam::uvec2(16, 9), glam::Vec2::ZERO);
        for depth in depths() {
            let clip = projection * glam::vec4(0.0, 0.0, -depth as f32, 1.0);
            let near = f64::from(camera.near);
            let stored = DepthEncoding::InfiniteReversed { near }.encode(depth);
            let projected = f64::from(clip.z / clip.w);
            if stored < 1.0 {
                assert!(
                    (stored / projected - 1.0).abs() < 1.0e-6,
                    "{depth}: {stored}, {projected}"
                );
            }
        }
    }

    /// Greatest relative error of a depth that was stored.
    #[test]
    fn precision_of_storage() {
        let worst = |encoding: DepthEncoding, storage: DepthStorage, most: f64| {
            let error = |depth: f64| (encoding.decode(storage.round(encoding.encode(depth))) / depth - 1.0).abs();
            depths().filter(|d| *d < most).map(error).fold(0.0, f64::max)
        };
        let [linear, perspective, reversed, infinite] = all_encodings();
        use DepthStorage::{Float32, Unorm16, Unorm24};
        // Floats are fine where small numbers are far away, and no better than 24 bits where 1 is.
        assert!(worst(linear, Float32, FAR) < 1.0e-7);
        assert!(worst(reversed, Float32, FAR) < 1.0e-6);
        assert!(worst(infinite, Float32, FAR) < 1.0e-7);
        let lost = worst(perspective, Float32, FAR);
        assert!((1.0e-5..1.0e-3).contains(&lost), "{lost:e}");
        // Half a step of 2⁻²⁴ of 1/near - 1/far, at depth d, is d / near · 2⁻²⁵ of it.
        for encoding in [perspective, reversed, infinite] {
            for (storage, bits) in [(Unorm24, 24), (Unorm16, 16)] {
                let most = 10.0;
                let step = most / NEAR / f64::from((1u32 << bits) - 1);
                let found = worst(encoding, storage, most);
                assert!(
                    found < 0.6 * step && found > 0.2 * step,
                    "{encoding:?} {storage:?}: {found:e}, {step:e}"
                );
            }
        }
    }
}
