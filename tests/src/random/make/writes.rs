//! Generates the writes of kernels to buffers and pictures. Each pixel has its own slot in every buffer. Changes of data
//! shared by all pixels are independent of their order, except where kernels need not be compared with a driver.

use super::types::{Lane, Ty};
use super::{Feature, Maker};

/// The slot of a pixel, also of the pixels outside of the frame that a workgroup has.
const SLOT: &str = "(pixel.y * 8 + pixel.x) as usize";

/// The slot of a pixel in a buffer of atomics, behind what all share.
const ATOMIC_SLOT: &str = "(pixel.y * 8 + pixel.x + 10) as usize";

/// Elements of a buffer of slots.
const SLOTS: i64 = 32;

/// The operation of each of the first elements of a buffer of atomics.
const SHARED: &[&str] = &["add", "min", "max", "and", "or", "xor"];

/// All operations of an index and a value.
const OPERATIONS: &[&str] = &["add", "min", "max", "and", "or", "xor", "exchange"];

/// The type of the elements of a buffer that is written.
fn element(name: &str) -> Ty {
    match name {
        "wf" => Ty::F32,
        "wv" | "wt" => Ty::Vec(Lane::F, 4),
        "wi" => Ty::Vec(Lane::I, 2),
        "xu" => Ty::U32,
        _ => Ty::I32,
    }
}

impl Maker {
    /// Buffers that are written, those of atomics or the others.
    fn written(&self, atomic: bool) -> Vec<&'static str> {
        let names = self.shape.inputs.iter().map(|(name, _)| *name);
        let first = if atomic { 'x' } else { 'w' };
        names
            .filter(|name| name.len() == 2 && name.starts_with(first))
            .collect()
    }

    /// Returns whether something may be written here.
    pub(super) fn writes(&self) -> bool {
        self.inputs && !(self.written(true).is_empty() && self.written(false).is_empty())
    }

    /// A write to a buffer.
    pub(super) fn write(&mut self) {
        let mut names = self.written(false);
        names.extend(self.written(true));
        let name = self.random.pick(&names);
        let ty = element(name);
        let want = self.wish(2).inferred(true);
        let value = self.with_effects(|m| m.expr(&ty, want));
        if name == "wt" {
            let at = match self.random.below(6) {
                // Outside: nothing happens.
                0 => "ivec2(-1 - pixel.x, pixel.y)",
                1 => "pixel + wt.size().as_ivec2()",
                _ => "pixel",
            };
            return self.line(format!("wt.store({at}, {value});"));
        }
        if name.starts_with('w') {
            let index = match self.random.below(8) {
                // Outside: nothing happens.
                0 => format!("{SLOT} + {SLOTS} * {}", self.random.between(1, 3)),
                1 => "(-1 - pixel.x) as usize".to_owned(),
                _ => SLOT.to_owned(),
            };
            return self.line(format!("{name}.store({index}, {value});"));
        }
        let (operation, index) = match self.random.below(7) {
            0..=2 => {
                let k = self.random.below(SHARED.len());
                (SHARED[k], k.to_string())
            }
            // A histogram.
            3..=4 => {
                let want = self.wish(1);
                ("add", format!("6 + ({} % 4) as usize", self.expr(&Ty::U32, want)))
            }
            5 => ("add", format!("{ATOMIC_SLOT} + {SLOTS}")),
            _ => (self.random.pick(OPERATIONS), ATOMIC_SLOT.to_owned()),
        };
        self.line(format!("{name}.{operation}({index}, {value});"));
    }

    /// A read of a buffer of atomics, which may change it.
    pub(super) fn atomic_read(&mut self, ty: &Ty) -> Option<String> {
        let fit: Vec<&str> = self
            .written(true)
            .into_iter()
            .filter(|name| element(name) == *ty)
            .collect();
        if fit.is_empty() || !self.inputs || self.reading {
            return None;
        }
        let name = self.random.pick(&fit);
        let index = match self.on(Feature::Ordered) && self.random.once_in(3) {
            true => self.index(11, false, 1),
            false => ATOMIC_SLOT.to_owned(),
        };
        if self.random.once_in(3) {
            return Some(format!("{name}.load({index})"));
        }
        let operation = self.random.pick(OPERATIONS);
        self.reading = true;
        let want = self.wish(1).inferred(true);
        let value = self.expr(ty, want);
        self.reading = false;
        Some(format!("{name}.{operation}({index}, {value})"))
    }
}
