//! Workgroups: invocations that go through a kernel together and share memory.

use super::storage::{AtomicElement, operations};
use glam::{IVec2, UVec2};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Invocations that compute a rectangle of pixels together, `WIDTH` across and `HEIGHT` down, at most 256 of them.
///
/// A kernel that takes one says what the whole workgroup does. What each of its threads does is a phase, [`Workgroup::each`]: all
/// threads end a phase before one begins the next. Every pixel of the frame is in one workgroup; at the right and lower border
/// some threads have pixels outside of the frame, which [`Thread::inside`] tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Workgroup<const WIDTH: usize, const HEIGHT: usize> {
    origin: IVec2,
    resolution: UVec2,
}

/// One of the threads of a [`Workgroup`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thread {
    /// Where it lies in its workgroup: from (0, 0) to (`WIDTH` - 1, `HEIGHT` - 1).
    pub local: IVec2,
    /// Its number in its workgroup, row by row: `local.y * WIDTH + local.x`.
    pub index: usize,
    /// Its pixel.
    pub pixel: IVec2,
    /// Whether its pixel is inside the frame. What a phase gives for one outside is dropped, but what it writes is not.
    pub inside: bool,
}

/// A value in each thread of a [`Workgroup`]: what a phase gives. A kernel that gives one gives each pixel its own.
#[derive(Clone, Debug, PartialEq)]
pub struct PerThread<T> {
    values: Vec<T>,
}

impl<T> PerThread<T> {
    /// The thread's own value.
    pub fn of(&self, thread: Thread) -> T
    where
        T: Copy,
    {
        self.values[thread.index]
    }

    /// The values of all threads, row by row.
    pub fn values(&self) -> &[T] {
        &self.values
    }
}

impl<const WIDTH: usize, const HEIGHT: usize> Workgroup<WIDTH, HEIGHT> {
    /// The workgroup whose first pixel is `origin`, in a frame of `resolution` pixels.
    pub fn new(origin: IVec2, resolution: UVec2) -> Self {
        Workgroup { origin, resolution }
    }

    /// All workgroups of a frame, row by row.
    pub fn all(resolution: UVec2) -> impl Iterator<Item = Self> {
        let across = resolution.x.div_ceil(WIDTH as u32);
        let down = resolution.y.div_ceil(HEIGHT as u32);
        let origins = (0..down).flat_map(move |y| (0..across).map(move |x| (x * WIDTH as u32, y * HEIGHT as u32)));
        origins.map(move |(x, y)| Workgroup::new(IVec2::new(x as i32, y as i32), resolution))
    }

    /// The pixel of its first thread.
    pub fn origin(&self) -> IVec2 {
        self.origin
    }

    /// A phase: what each thread does, once all of them have done what comes before. Gives what each of them gives.
    ///
    /// Threads may come in any order: within a phase none may read or write what another one writes of a [`Shared`].
    pub fn each<T>(&self, f: impl Fn(Thread) -> T) -> PerThread<T> {
        let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let threads = places.map(|(x, y)| {
            let local = IVec2::new(x as i32, y as i32);
            let pixel = self.origin + local;
            Thread {
                local,
                index: y * WIDTH + x,
                pixel,
                inside: (pixel.x as u32) < self.resolution.x && (pixel.y as u32) < self.resolution.y,
            }
        });
        PerThread {
            values: threads.map(f).collect(),
        }
    }
}

/// An array that the threads of a [`Workgroup`] share: `Shared<[Vec4; 256]>`. All elements are 0 where a workgroup begins.
///
/// Elements are `f32`, `i32`, `u32`, or vectors of 2 or 4 of them; what a kernel shares takes 16 KiB at most. It is read and
/// written in phases.
#[derive(Debug)]
pub struct Shared<A> {
    elements: Mutex<A>,
}

impl<T: Copy + Default, const N: usize> Default for Shared<[T; N]> {
    fn default() -> Self {
        Shared::new()
    }
}

impl<T: Copy + Default, const N: usize> Shared<[T; N]> {
    /// An array of zeros, for one workgroup.
    pub fn new() -> Self {
        Shared {
            elements: Mutex::new([T::default(); N]),
        }
    }

    fn locked(&self) -> MutexGuard<'_, [T; N]> {
        self.elements.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of elements.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        N
    }

    /// The element at `index`, or the last one beyond the end.
    pub fn load(&self, index: usize) -> T {
        self.locked()[index.min(N - 1)]
    }

    /// Puts `value` at `index`; beyond the end nothing happens.
    pub fn store(&self, index: usize, value: T) {
        if let Some(place) = self.locked().get_mut(index) {
            *place = value;
        }
    }
}

/// An array of `u32` or `i32` that the threads of a [`Workgroup`] change together, each change at once: `AtomicShared<[u32; 256]>`.
/// All elements are 0 where a workgroup begins.
///
/// Each method gives what was there before. At an index beyond the end nothing happens, and 0 is given. In which order threads
/// come within a phase is not said.
#[derive(Debug)]
pub struct AtomicShared<A: SharedAtomics> {
    elements: A::Cells,
}

/// What an [`AtomicShared`] holds: `[u32; N]` or `[i32; N]`.
pub trait SharedAtomics {
    /// Its elements' type.
    type Element: AtomicElement;
    /// As they are kept.
    type Cells;
    /// As they are kept, all 0.
    fn zeros() -> Self::Cells;
    /// A cell, if the index is inside.
    fn at(cells: &Self::Cells, index: usize) -> Option<&<Self::Element as AtomicElement>::Cell>;
    /// Number of elements.
    const LEN: usize;
}

impl<T: AtomicElement, const N: usize> SharedAtomics for [T; N] {
    type Element = T;
    type Cells = [T::Cell; N];
    const LEN: usize = N;

    fn zeros() -> Self::Cells {
        std::array::from_fn(|_| T::Cell::from(T::default()))
    }

    fn at(cells: &Self::Cells, index: usize) -> Option<&T::Cell> {
        cells.get(index)
    }
}

impl<A: SharedAtomics> Default for AtomicShared<A> {
    fn default() -> Self {
        AtomicShared::new()
    }
}

operations!({ impl<A: SharedAtomics> AtomicShared<A> } A::Element);

impl<A: SharedAtomics> AtomicShared<A> {
    /// An array of zeros, for one workgroup.
    pub fn new() -> Self {
        AtomicShared { elements: A::zeros() }
    }

    fn at(&self, index: usize, change: impl FnOnce(&<A::Element as AtomicElement>::Cell) -> A::Element) -> A::Element {
        A::at(&self.elements, index).map_or_else(A::Element::default, change)
    }

    /// Number of elements.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        A::LEN
    }

    /// What is at `index` now.
    pub fn load(&self, index: usize) -> A::Element {
        self.at(index, A::Element::load)
    }
}
