//! Work of compiling kernels as an oracle beside their bits: a kernel that takes a hundred times the work of others of its
//! size shows that something is evaluated again and again.

use std::collections::BTreeMap;
use std::fmt;

/// Times the median of its size that the work of compiling a kernel may be.
pub const MOST: u64 = 100;

/// Kernels of a size below which they have no median worth the name.
const FEWEST: u64 = 40;

/// Steps of size and of work in an octave.
const STEPS: f64 = 4.0;

/// Work of compiling many kernels, by size.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Works {
    sizes: BTreeMap<u32, Sized>,
}

/// Work of kernels of about one size.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Sized {
    /// Number of kernels by approximate work.
    counts: BTreeMap<u32, u64>,
    /// The most, with the kernel and the form.
    heaviest: (u64, u64, String),
}

/// A kernel whose work stands out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outlier {
    /// Seed of the kernel.
    pub seed: u64,
    /// The form that it was compiled to.
    pub form: String,
    /// Work of the kernel.
    pub work: u64,
    /// About the median of kernels of its size.
    pub median: u64,
}

impl fmt::Display for Outlier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Outlier {
            seed,
            form,
            work,
            median,
        } = self;
        write!(
            f,
            "kernel {seed} takes the work of {work} with {form}; half of those of its size take at most {median}"
        )
    }
}

fn step(n: u64) -> u32 {
    ((n.max(1) as f64).log2() * STEPS) as u32
}

impl Works {
    /// Adds a kernel whose text has so many bytes.
    pub fn add(&mut self, size: usize, work: u64, seed: u64, form: impl fmt::Display) {
        let sized = self.sizes.entry(step(size as u64)).or_default();
        *sized.counts.entry(step(work)).or_default() += 1;
        if work > sized.heaviest.0 {
            sized.heaviest = (work, seed, form.to_string());
        }
    }

    /// Adds all of another.
    pub fn merge(&mut self, other: &Works) {
        for (size, theirs) in &other.sizes {
            let own = self.sizes.entry(*size).or_default();
            for (work, count) in &theirs.counts {
                *own.counts.entry(*work).or_default() += count;
            }
            if theirs.heaviest.0 > own.heaviest.0 {
                own.heaviest = theirs.heaviest.clone();
            }
        }
    }

    /// The kernel with the most work of each size, if that is more than [`MOST`] times the median.
    pub fn outliers(&self) -> Vec<Outlier> {
        self.sizes.values().filter_map(Sized::outlier).collect()
    }
}

impl Sized {
    fn outlier(&self) -> Option<Outlier> {
        let all: u64 = self.counts.values().sum();
        let mut below = 0;
        let median = self.counts.iter().find(|(_, count)| {
            below += **count;
            below * 2 >= all
        });
        let median = median.map_or(0.0, |(step, _)| ((f64::from(*step) + 1.0) / STEPS).exp2()) as u64;
        let (work, seed, form) = &self.heaviest;
        (all >= FEWEST && *work > MOST * median).then(|| Outlier {
            seed: *seed,
            form: form.clone(),
            work: *work,
            median,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_a_hundred_times_the_median_stands_out() {
        let mut works = Works::default();
        for seed in 0..FEWEST {
            works.add(900, 1000 + seed, seed, "full");
        }
        works.add(900, 90_000, 70, "full");
        assert_eq!(works.outliers(), []);
        let mut more = Works::default();
        more.add(910, 200_000, 71, "keep");
        // A kernel of another size has no others to be compared with.
        more.add(9000, 900_000, 72, "keep");
        works.merge(&more);
        let outliers = works.outliers();
        assert_eq!(outliers.len(), 1, "{outliers:?}");
        assert_eq!(
            (outliers[0].seed, outliers[0].work, outliers[0].form.as_str()),
            (71, 200_000, "keep")
        );
        assert!((1000..1300).contains(&outliers[0].median), "{outliers:?}");
    }
}
