//! Many independent runs on all cores.

#[cfg(not(target_arch = "wasm32"))]
use std::sync::atomic::{AtomicUsize, Ordering};
#[cfg(not(target_arch = "wasm32"))]
use std::thread;

/// `of(0)` to `of(count - 1)`, in this order: a browser's core has no threads, its Workers share the runs.
#[cfg(target_arch = "wasm32")]
pub fn at_once<T>(count: usize, of: impl Fn(usize) -> T) -> Vec<T> {
    (0..count).map(of).collect()
}

/// `of(0)` to `of(count - 1)`, in this order, computed on as many threads as there are cores. What each gives must
/// not depend on the others.
#[cfg(not(target_arch = "wasm32"))]
pub fn at_once<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = thread::available_parallelism().map_or(1, usize::from).min(count);
    if threads < 2 {
        return (0..count).map(of).collect();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return done;
            }
            done.push((index, of(index)));
        }
    };
    let mut all: Vec<(usize, T)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let parts = workers.into_iter().map(|worker| match worker.join() {
            Ok(part) => part,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        parts.flatten().collect()
    });
    all.sort_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, value)| value).collect()
}

#[cfg(test)]
mod tests {
    use super::at_once;

    #[test]
    fn answers_keep_the_order_of_the_questions() {
        for count in [0, 1, 2, 7, 1000] {
            assert_eq!(at_once(count, |k| k * k), (0..count).map(|k| k * k).collect::<Vec<_>>());
        }
    }
}
