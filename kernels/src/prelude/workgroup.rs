//! Workgroups: invocations that run a kernel together and share memory.

use super::storage::{AtomicElement, operations};
use glam::{IVec2, UVec2};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Invocations that compute a rectangle of `WIDTH` by `HEIGHT` pixels together, at most 256 of them.
///
/// A kernel that takes one describes the whole workgroup. The work of each thread is a phase, [`Workgroup::each`]: all
/// threads end a phase before the next begins. Every pixel of the frame is in exactly one workgroup. At the right and lower
/// border some threads have pixels outside of the frame; see [`Thread::inside`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Workgroup<const WIDTH: usize, const HEIGHT: usize> {
    origin: IVec2,
    resolution: UVec2,
}

/// A thread of a [`Workgroup`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thread {
    /// Position in the workgroup: from (0, 0) to (`WIDTH` - 1, `HEIGHT` - 1).
    pub local: IVec2,
    /// Index in the workgroup, row by row: `local.y * WIDTH + local.x`.
    pub index: usize,
    /// Pixel of this thread.
    pub pixel: IVec2,
    /// `true` if `pixel` is inside the frame. The result of a phase outside the frame is dropped, but its writes are not.
    pub inside: bool,
}

/// A value for each thread of a [`Workgroup`]: the result of a phase. A kernel that returns one returns each pixel's own value.
#[derive(Clone, Debug, PartialEq)]
pub struct PerThread<T> {
    values: Vec<T>,
}

impl<T> PerThread<T> {
    /// Returns the value of `thread`.
    pub fn of(&self, thread: Thread) -> T
    where
        T: Copy,
    {
        self.values[thread.index]
    }

    /// Values of all threads, row by row.
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

    /// Pixel of the first thread.
    pub fn origin(&self) -> IVec2 {
        self.origin
    }

    /// Runs a phase: `f` for each thread, once all of them have completed the previous phase. Returns their results.
    ///
    /// The order of threads is unspecified: within a phase no thread may access an element of a [`Shared`] that another writes.
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

/// An array shared by the threads of a [`Workgroup`]: `Shared<[Vec4; 256]>`. All elements are 0 when a workgroup begins.
///
/// Elements are `f32`, `i32`, `u32`, or vectors of 2 or 4 of them. A kernel may share at most 16 KiB. The array is read and
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
    /// Creates an array of zeros for one workgroup.
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

    /// Returns the element at `index`, or the last one if `index` is out of bounds.
    pub fn load(&self, index: usize) -> T {
        self.locked()[index.min(N - 1)]
    }

    /// Stores `value` at `index`. An index out of bounds has no effect.
    pub fn store(&self, index: usize, value: T) {
        if let Some(place) = self.locked().get_mut(index) {
            *place = value;
        }
    }
}

/// An array of `u32` or `i32` that the threads of a [`Workgroup`] modify atomically: `AtomicShared<[u32; 256]>`.
/// All elements are 0 when a workgroup begins.
///
/// Each method returns the previous value. An index out of bounds has no effect, and 0 is returned. The order of threads
/// within a phase is unspecified.
#[derive(Debug)]
pub struct AtomicShared<A: SharedAtomics> {
    elements: A::Cells,
}

/// Array type of an [`AtomicShared`]: `[u32; N]` or `[i32; N]`.
pub trait SharedAtomics {
    /// Element type.
    type Element: AtomicElement;
    /// Storage of the elements.
    type Cells;
    /// Storage with all elements 0.
    fn zeros() -> Self::Cells;
    /// Returns the cell at `index`, or `None` if it is out of bounds.
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
    /// Creates an array of zeros for one workgroup.
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

    /// Returns the current value at `index`.
    pub fn load(&self, index: usize) -> A::Element {
        self.at(index, A::Element::load)
    }
}
