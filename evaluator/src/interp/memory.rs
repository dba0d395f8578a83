//! Memory that a kernel writes: buffers and workgroup memory, with the last invocations that accessed it.

use crate::ir::arith::Cells;
use crate::ir::{Access, Graph, Memory};

/// Undefined behaviour of the invocations of a workgroup.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Disorder {
    /// An invocation wrote an element that another one read or wrote, without a barrier between.
    #[error(
        "threads {threads:?} of the workgroup at {origin:?} both use `{name}[{index}]` in one phase, and one of them writes it"
    )]
    Race {
        /// Name of the workgroup memory in the kernel.
        name: String,
        /// The element.
        index: usize,
        /// The numbers of the two, row by row.
        threads: [u32; 2],
        /// The workgroup's first pixel.
        origin: [u32; 2],
    },
    /// They do not agree on a condition or a bound around a phase.
    #[error("the threads of the workgroup at {origin:?} do not agree on which phases to run")]
    Divergence {
        /// The workgroup's first pixel.
        origin: [u32; 2],
    },
}

/// Accesses to an element since the last barrier.
#[derive(Clone, Copy, Debug, Default)]
struct Touched {
    phase: u32,
    writer: Option<u32>,
    reader: Option<u32>,
    /// `true` if others than `reader` have read it too.
    several: bool,
}

/// An element that is shared.
#[derive(Clone, Copy, Debug, Default)]
struct Element {
    cells: Cells,
    touched: Touched,
}

/// Memory that is written.
#[derive(Clone, Default)]
pub struct Memories {
    /// By index of the buffer; of those that are only read nothing.
    buffers: Vec<Vec<Cells>>,
    shared: Vec<Vec<Element>>,
    /// Row by row; nothing where no invocation has stored.
    images: Vec<Vec<Option<Cells>>>,
    names: Vec<String>,
    /// Barriers that have been passed, in all workgroups.
    phase: u32,
    /// The invocation that is running.
    pub thread: u32,
    origin: [u32; 2],
    disorder: Option<Disorder>,
}

impl Memories {
    /// As they are before the first invocation.
    pub fn new(graph: &Graph, buffers: &[Vec<Cells>], image_sizes: &[[u32; 2]]) -> Memories {
        let written = graph.buffers.iter().zip(buffers);
        let written = written.map(|(buffer, elements)| match buffer.access {
            Access::Read => Vec::new(),
            Access::Write | Access::Atomic => elements.clone(),
        });
        Memories {
            buffers: written.collect(),
            shared: graph
                .shared
                .iter()
                .map(|s| vec![Element::default(); s.len as usize])
                .collect(),
            images: image_sizes
                .iter()
                .map(|[width, height]| vec![None; (width * height) as usize])
                .collect(),
            names: graph.shared.iter().map(|s| s.name.clone()).collect(),
            ..Memories::default()
        }
    }

    /// A buffer that is written, as it is now.
    pub fn buffer(&self, index: usize) -> &[Cells] {
        &self.buffers[index]
    }

    /// A picture that is written, as it is now.
    pub fn image(&self, index: usize) -> &[Option<Cells>] {
        &self.images[index]
    }

    pub fn disorder(&self) -> Option<&Disorder> {
        self.disorder.as_ref()
    }

    /// Another workgroup begins: what it shares is 0.
    pub fn begin_workgroup(&mut self, origin: [u32; 2]) {
        self.shared
            .iter_mut()
            .flatten()
            .for_each(|element| element.cells = [0; 4]);
        self.origin = origin;
        self.barrier();
    }

    /// All invocations of the workgroup have come here.
    pub fn barrier(&mut self) {
        self.phase += 1;
    }

    /// Notes that the invocations do not agree on which phases to run.
    pub fn note_divergence(&mut self) {
        let origin = self.origin;
        self.disorder.get_or_insert(Disorder::Divergence { origin });
    }

    /// An element of what is shared.
    pub fn load_shared(&mut self, memory: Memory, index: usize) -> Cells {
        let Memory::Shared(k) = memory else { return [0; 4] };
        let (phase, thread) = (self.phase, self.thread);
        let Some(element) = self.shared[k as usize].get_mut(index) else {
            return [0; 4];
        };
        let touched = element.touched.in_phase(phase);
        touched.several |= touched.reader.is_some_and(|other| other != thread);
        touched.reader = Some(thread);
        let (other, cells) = (touched.writer, element.cells);
        self.note_race(k, index, other);
        cells
    }

    /// Writes an element, if there is one.
    pub fn store(&mut self, memory: Memory, index: usize, value: Cells) -> Cells {
        let (phase, thread) = (self.phase, self.thread);
        let k = match memory {
            Memory::Buffer(_) => return self.change(memory, index, |_| value),
            Memory::Image(k) => {
                if let Some(texel) = self.images[k as usize].get_mut(index) {
                    *texel = Some(value);
                }
                return [0; 4];
            }
            Memory::Shared(k) => k,
        };
        let Some(element) = self.shared[k as usize].get_mut(index) else {
            return [0; 4];
        };
        let touched = element.touched.in_phase(phase);
        // Several may write the same.
        let writer = touched.writer.filter(|_| element.cells != value);
        let reader = match touched.several {
            true => Some(u32::MAX),
            false => touched.reader,
        };
        touched.writer = Some(thread);
        let before = std::mem::replace(&mut element.cells, value);
        self.note_race(k, index, writer);
        self.note_race(k, index, reader);
        before
    }

    /// Changes an element at once, if there is one, and gives what was there before.
    pub fn change(&mut self, memory: Memory, index: usize, change: impl FnOnce(Cells) -> Cells) -> Cells {
        let place = match memory {
            Memory::Buffer(k) => self.buffers[k as usize].get_mut(index),
            Memory::Image(_) => None,
            Memory::Shared(k) => self.shared[k as usize].get_mut(index).map(|element| &mut element.cells),
        };
        let Some(place) = place else { return [0; 4] };
        std::mem::replace(place, change(*place))
    }

    /// Notes a race with another invocation.
    fn note_race(&mut self, k: u32, index: usize, other: Option<u32>) {
        let Some(other) = other.filter(|other| *other != self.thread) else {
            return;
        };
        // Stands for one of several readers.
        let other = if other == u32::MAX {
            u32::from(self.thread == 0)
        } else {
            other
        };
        let (name, origin) = (self.names[k as usize].clone(), self.origin);
        let threads = [other.min(self.thread), other.max(self.thread)];
        self.disorder.get_or_insert(Disorder::Race {
            name,
            index,
            threads,
            origin,
        });
    }
}

impl Touched {
    /// Returns the accesses in a phase: none, if the last access was in an earlier one.
    fn in_phase(&mut self, phase: u32) -> &mut Touched {
        if self.phase != phase {
            *self = Touched {
                phase,
                ..Touched::default()
            };
        }
        self
    }
}
