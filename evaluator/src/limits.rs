//! Limits of what the generator may spend on one kernel: time, and memory of values.
//!
//! A [`Meter`] is open while a kernel is compiled or emitted. It counts work and the memory that values hold, each in a number that
//! depends on the kernel alone, and has a deadline. All of it belongs to the thread that opened the meter.

use std::cell::Cell;
use std::fmt;
use std::time::Duration;

#[cfg(not(target_arch = "wasm32"))]
use std::time::Instant;

/// Limits of what the generator may spend on one kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest time, from reading the source to the last text; by default 60 s. WebAssembly has no clock of its own: there the host
    /// ends what takes too long.
    pub time: Duration,
    /// Most bytes of values and operations held at once while a kernel is evaluated; by default 2 GB.
    pub memory: u64,
}

impl Limits {
    /// Limits where none are set.
    pub const DEFAULT: Limits = Limits {
        time: Duration::from_secs(60),
        memory: 2_000_000_000,
    };
}

impl Default for Limits {
    fn default() -> Self {
        Limits::DEFAULT
    }
}

/// A limit that is exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// The time that is up.
    Time(Duration),
    /// The bytes that do not suffice.
    Memory(u64),
}

impl Excess {
    /// The option that raises the limit, for messages.
    pub const fn help(self) -> &'static str {
        match self {
            Excess::Time(_) => "allow more time: `--time-limit SECONDS`, or `.time_limit(..)` in build.rs",
            Excess::Memory(_) => "allow more memory: `--memory-limit MEGABYTES`, or `.memory_limit(..)` in build.rs",
        }
    }
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Excess::Time(limit) => write!(f, "more than {} s", limit.as_secs_f64()),
            Excess::Memory(limit) => write!(f, "more than {} MB", limit / 1_000_000),
        }
    }
}

/// State of the thread's meter.
#[derive(Clone, Copy)]
struct State {
    limits: Limits,
    #[cfg(not(target_arch = "wasm32"))]
    begun: Instant,
    work: u64,
}

thread_local! {
    static STATE: Cell<Option<State>> = const { Cell::new(None) };
    /// Bytes of values that are held.
    static HELD: Cell<u64> = const { Cell::new(0) };
}

/// Time and work since a meter was opened on this thread, until it is dropped.
pub struct Meter {
    outer: Option<State>,
}

impl Meter {
    /// Opens a meter. Inside of another one that one's limits apply, and the work counts there too.
    pub fn open(limits: Limits) -> Meter {
        let outer = STATE.get();
        let state = outer.unwrap_or_else(|| State {
            limits,
            #[cfg(not(target_arch = "wasm32"))]
            begun: Instant::now(),
            work: 0,
        });
        STATE.set(Some(State { work: 0, ..state }));
        Meter { outer }
    }

    /// As [`Meter::open`], with so much of the time taken already.
    pub fn resume(limits: Limits, taken: Duration) -> Meter {
        let meter = Meter::open(limits);
        #[cfg(not(target_arch = "wasm32"))]
        if let (None, Some(mut state)) = (meter.outer, STATE.get()) {
            state.begun = state.begun.checked_sub(taken).unwrap_or(state.begun);
            STATE.set(Some(state));
        }
        #[cfg(target_arch = "wasm32")]
        let _ = taken;
        meter
    }

    /// Time since the outermost meter of this thread was opened; 0 in WebAssembly.
    pub fn time(&self) -> Duration {
        #[cfg(not(target_arch = "wasm32"))]
        return STATE.get().map_or(Duration::ZERO, |state| state.begun.elapsed());
        #[cfg(target_arch = "wasm32")]
        Duration::ZERO
    }

    /// Work since the meter was opened.
    pub fn work(&self) -> u64 {
        STATE.get().map_or(0, |state| state.work)
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        let own = self.work();
        STATE.set(self.outer.map(|outer| State {
            work: outer.work.saturating_add(own),
            ..outer
        }));
    }
}

/// Counts work: expressions that are evaluated, nodes that a pass visits, statements that are rewritten.
pub fn count_work(work: u64) {
    if let Some(mut state) = STATE.get() {
        state.work = state.work.saturating_add(work);
        STATE.set(Some(state));
    }
}

/// The limit that is exceeded now, if one is; `operations` is the number of nodes that are held.
pub fn exceeded_limit(operations: usize) -> Option<Excess> {
    let state = STATE.get()?;
    let held = HELD.get().saturating_add((operations * NODE) as u64);
    if held > state.limits.memory {
        return Some(Excess::Memory(state.limits.memory));
    }
    late(&state, Duration::ZERO)
}

/// The limit that would be exceeded by something that takes so long.
pub fn would_exceed(ahead: Duration) -> Option<Excess> {
    late(&STATE.get()?, ahead)
}

#[cfg(not(target_arch = "wasm32"))]
fn late(state: &State, ahead: Duration) -> Option<Excess> {
    let limit = state.limits.time;
    (state.begun.elapsed().saturating_add(ahead) > limit).then_some(Excess::Time(limit))
}

#[cfg(target_arch = "wasm32")]
fn late(_: &State, _: Duration) -> Option<Excess> {
    None
}

/// Bytes that a node takes, with its arguments, origin and place in tables.
const NODE: usize = 256;

/// Memory that is counted as long as this exists.
#[derive(Debug)]
pub struct Held(usize);

impl Held {
    /// Counts so many bytes.
    pub fn new(bytes: usize) -> Held {
        HELD.set(HELD.get().saturating_add(bytes as u64));
        Held(bytes)
    }
}

impl Clone for Held {
    fn clone(&self) -> Self {
        Held::new(self.0)
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        // On the thread that made it: values do not leave theirs.
        HELD.set(HELD.get().saturating_sub(self.0 as u64));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_counts_as_long_as_it_is_held() {
        let limits = Limits {
            memory: 1000 + NODE as u64,
            ..Limits::default()
        };
        let _meter = Meter::open(limits);
        let held = Held::new(800);
        assert_eq!(exceeded_limit(1), None);
        let copy = held.clone();
        assert_eq!(exceeded_limit(1), Some(Excess::Memory(limits.memory)));
        drop(copy);
        assert_eq!(exceeded_limit(1), None);
    }

    #[test]
    fn time_is_up_once_it_is_over() {
        let limits = Limits {
            time: Duration::from_secs(3600),
            ..Limits::default()
        };
        let outer = Meter::open(limits);
        assert_eq!(exceeded_limit(0), None);
        assert_eq!(would_exceed(Duration::from_secs(4000)), Some(Excess::Time(limits.time)));
        count_work(3);
        {
            let inner = Meter::open(Limits {
                time: Duration::ZERO,
                ..limits
            });
            count_work(4);
            assert_eq!((inner.work(), exceeded_limit(0)), (4, None));
        }
        assert_eq!(outer.work(), 7);
        drop(outer);
        assert_eq!(
            exceeded_limit(usize::MAX / NODE),
            None,
            "nothing is limited without a meter"
        );
    }
}
