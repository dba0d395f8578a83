//! Passes that are made on other threads, whose errors stay apart.

use crate::common::{self, ramp, view};

use common::{COPY, Fixture, Gpu, Stage};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Barrier};
use std::time::{Duration, Instant};
use straightline_runtime::{Error, Pass, Pending, wgpu};

/// Polls until the result is there.
fn poll<T: Send + 'static>(pending: &mut Pending<T>) -> Result<T, Error> {
    let start = Instant::now();
    loop {
        if let Some(result) = pending.poll() {
            return result;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "nothing was made");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_pass_is_there_when_it_is_made() {
    let gpu = Gpu::new();
    let size = [5, 3];
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Compute);
    let gate = Arc::new(Barrier::new(2));
    let (device, opened) = (gpu.device.clone(), Arc::clone(&gate));
    let mut pending = Pending::start(move || {
        opened.wait();
        Pass::from_json(&device, &manifest, &wgsl)
    });
    assert!(pending.poll().is_none(), "it cannot be made yet");
    gate.wait();
    let pass = poll(&mut pending).expect("a pass");
    assert!(pending.poll().is_none() && pending.wait().is_none(), "it was taken");
    let (color, target) = (view(&gpu.upload(size, 1, &ramp(size, 1))), gpu.target(size));
    let mut encoder = gpu.encoder();
    pass.bind(&[("color", &color)], &view(&target))
        .expect("to bind")
        .encode(&mut encoder);
    gpu.submit(encoder);
    assert_eq!(gpu.download(&target), ramp(size, 1));
}

#[test]
fn a_panic_reaches_the_thread_that_asks() {
    let pending = Pending::<Pass>::start(|| panic!("of the caller"));
    let panic = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| pending.wait())).expect_err("a panic");
    assert_eq!(panic.downcast_ref(), Some(&"of the caller"));
}

/// wgpu finds these errors, in the scopes of the thread that makes the pass.
#[test]
fn errors_of_several_threads_stay_apart() {
    const THREADS: usize = 6;
    let gpu = Gpu::new();
    let uncaptured = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&uncaptured);
    gpu.device.on_uncaptured_error(Arc::new(move |_: wgpu::Error| {
        count.fetch_add(1, Ordering::Relaxed);
    }));
    let own = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    for round in 0..8 {
        let gate = Arc::new(Barrier::new(THREADS));
        let making: Vec<Pending<Pass>> = (0..THREADS)
            .map(|number| {
                let (device, gate) = (gpu.device.clone(), Arc::clone(&gate));
                let Fixture { manifest, mut wgsl } = COPY.emit(Stage::Compute);
                if number == round % THREADS {
                    // Parses, but does not validate.
                    wgsl += "fn nothing() -> f32 {}";
                }
                Pending::start(move || {
                    gate.wait();
                    Pass::from_json(&device, &manifest, &wgsl)
                })
            })
            .collect();
        for (number, pending) in making.into_iter().enumerate() {
            match pending.wait().expect("a result") {
                Ok(_) => assert_ne!(number, round % THREADS),
                Err(error) => {
                    assert_eq!(number, round % THREADS, "{error}");
                    assert!(matches!(error, Error::Shader { .. }), "{error}");
                    assert!(error.to_string().contains("nothing"), "{error}");
                }
            }
        }
    }
    assert!(
        pollster::block_on(own.pop()).is_none(),
        "no error in the caller's scope"
    );
    assert_eq!(uncaptured.load(Ordering::Relaxed), 0);
}
