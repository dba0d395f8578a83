//! Work on several threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Calls `work` on each item, on several threads, and returns the results in the order of the items.
pub(super) fn map_in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::with_capacity(items.len())));
    let run = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(k) else { break };
            let result = work(item);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((k, result));
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..thread_count().min(items.len()) {
            // This thread does the work that none is started for.
            let _ = std::thread::Builder::new().spawn_scoped(scope, run);
        }
        run();
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Number of threads: cargo's number of jobs in a build script, and at most one a core.
fn thread_count() -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = std::env::var("NUM_JOBS").ok().and_then(|jobs| jobs.parse().ok());
    jobs.map_or(cores, |jobs: usize| jobs.clamp(1, cores))
}

#[cfg(test)]
mod tests {
    use super::map_in_parallel;

    #[test]
    fn results_have_the_order_of_the_items() {
        let items: Vec<u32> = (0..100).collect();
        // Later items are done sooner.
        let slow = |k: &u32| {
            std::thread::sleep(std::time::Duration::from_micros(u64::from(100 - k)));
            2 * k
        };
        assert_eq!(
            map_in_parallel(&items, slow),
            items.iter().map(|k| 2 * k).collect::<Vec<_>>()
        );
        assert!(map_in_parallel(&[], slow).is_empty());
    }
}
