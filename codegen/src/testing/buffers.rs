//! Buffers of a test's kernel: its cases, and the failures that its invocations record.

use super::file::TestKernel;
use super::outcome::Outcome;
use straightline_evaluator::front::testing::{CASES, COUNTS, FLOATS, STATE, WORDS};
use straightline_kernels::properties::{Argument, Case};

/// Invocations in a row.
const WIDTH: usize = 256;

/// Contents of the buffers before a run, and the size of the frame whose pixels are the cases.
pub struct Buffers {
    /// Width and height; the last row may have more pixels than there are cases left.
    pub size: [u32; 2],
    /// Name and elements of each buffer.
    pub contents: Vec<(&'static str, Vec<[f64; 4]>)>,
}

impl TestKernel {
    /// Returns the buffers for cases.
    pub fn buffers(&self, cases: &[Case]) -> Buffers {
        let width = cases.len().clamp(1, WIDTH);
        let height = cases.len().max(1).div_ceil(width);
        let invocations = width * height;
        let zeros = |count: usize| vec![[0.0; 4]; count * invocations];
        let mut contents = vec![(STATE, zeros(2)), (FLOATS, zeros(2)), (WORDS, zeros(2))];
        contents.extend(self.counts_buffer());
        if !self.test.arguments.is_empty() {
            let last = cases.last().map_or(&[][..], Vec::as_slice);
            let padding = std::iter::repeat_n(last, invocations - cases.len());
            let all = cases.iter().map(Vec::as_slice).chain(padding);
            let elements = all.flat_map(|case| self.element_of(case));
            contents.push((CASES, elements.collect()));
        }
        Buffers {
            size: [width as u32, height as u32],
            contents,
        }
    }

    /// The buffer with the executions by probe, of a test that is covered.
    pub(super) fn counts_buffer(&self) -> Option<(&'static str, Vec<[f64; 4]>)> {
        self.test.covered.then(|| (COUNTS, vec![[0.0; 4]; self.probes]))
    }

    /// The numbers and vectors of a case.
    fn element_of(&self, case: &[u32]) -> Vec<[f64; 4]> {
        let mut rest = case.iter();
        let mut element = Vec::new();
        for (_, argument) in &self.test.arguments {
            let Argument { component, width, .. } = *argument;
            for _ in 0..argument.elements.unwrap_or(1) {
                let mut value = [0.0; 4];
                for (slot, bits) in value.iter_mut().zip(rest.by_ref().take(width)) {
                    *slot = component.value(*bits);
                }
                element.push(value);
            }
        }
        element
    }

    /// Reads the outcome of each of `count` cases from the buffers after a run. Buffers that no assertion writes may be missing.
    pub fn outcomes(&self, buffers: &[(String, Vec<[f64; 4]>)], count: usize) -> Vec<Outcome> {
        let of = |name: &str| {
            buffers
                .iter()
                .find(|(known, _)| known == name)
                .map(|(_, values)| values.as_slice())
        };
        let pair = |values: Option<&[[f64; 4]]>, k: usize| {
            let at = |k: usize| values.and_then(|values| values.get(k)).copied().unwrap_or_default();
            [at(2 * k), at(2 * k + 1)]
        };
        let outcome = |k: usize| {
            let state = pair(of(STATE), k).map(|element| element[0]);
            Outcome::decode(&self.sites, state, pair(of(FLOATS), k), pair(of(WORDS), k))
        };
        (0..count).map(outcome).collect()
    }
}
