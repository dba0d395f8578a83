//! GPU timestamps.

use crate::common;

use common::{COPY, Fixture, Gpu, STAGES, Stage, ramp, view};
use std::time::{Duration, Instant};
use straightline_runtime::{Error, Pass, Timer, wgpu};

fn timing_gpu() -> Gpu {
    Gpu::with(wgpu::Features::TIMESTAMP_QUERY, wgpu::Limits::default())
}

fn pass(gpu: &Gpu, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = COPY.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

#[test]
fn spans_are_read_in_order_and_within_wall_time() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 2).expect("a timer");
    let images =
        [[1, 1], [1024, 1024]].map(|size| (view(&gpu.upload(size, 1, &ramp(size, 1))), view(&gpu.target(size))));
    for stage in STAGES {
        let pass = pass(&gpu, stage);
        // The least of several runs, because other processes may take the processor of a software driver.
        let mut least = [Duration::MAX; 2];
        for _ in 0..8 {
            let start = Instant::now();
            let mut encoder = gpu.encoder();
            for (color, target) in &images {
                pass.bind(&[("color", color)], target)
                    .expect("to bind")
                    .encode_timed(&mut encoder, &mut timer)
                    .expect("to encode");
            }
            timer.resolve(&mut encoder).expect("to resolve");
            gpu.submit(encoder);
            let spans = timer.read().expect("timestamps");
            let wall = start.elapsed();
            assert_eq!(spans.len(), 2);
            assert!(
                spans[1] > Duration::ZERO && spans.iter().all(|span| *span <= wall),
                "{spans:?} in {wall:?}"
            );
            least = [least[0].min(spans[0]), least[1].min(spans[1])];
        }
        assert!(
            least[0] < least[1],
            "{stage:?}: one pixel in {:?}, a million in {:?}",
            least[0],
            least[1]
        );
    }
}

#[test]
fn batches_are_kept_apart() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 2).expect("a timer");
    let pass = pass(&gpu, Stage::Compute);
    let color = view(&gpu.upload([8, 8], 1, &ramp([8, 8], 1)));
    let target = view(&gpu.target([8, 8]));
    for count in [2, 1, 0] {
        let mut encoder = gpu.encoder();
        for _ in 0..count {
            pass.bind(&[("color", &color)], &target)
                .expect("to bind")
                .encode_timed(&mut encoder, &mut timer)
                .expect("to encode");
        }
        timer.resolve(&mut encoder).expect("to resolve");
        gpu.submit(encoder);
    }
    for count in [2, 1, 0] {
        assert_eq!(timer.read().expect("timestamps").len(), count);
    }
    assert!(matches!(timer.read(), Err(Error::TimerNotResolved)));
}

#[test]
fn spans_come_without_waiting() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 2).expect("a timer");
    assert!(matches!(timer.try_read(), Err(Error::TimerNotResolved)));
    let pass = pass(&gpu, Stage::Compute);
    let size = [1024, 1024];
    let (color, target) = (view(&gpu.upload(size, 1, &ramp(size, 1))), view(&gpu.target(size)));
    let bound = pass.bind(&[("color", &color)], &target).expect("to bind");
    for count in [2, 0, 1] {
        let mut encoder = gpu.encoder();
        for _ in 0..count {
            bound.encode_timed(&mut encoder, &mut timer).expect("to encode");
        }
        timer.resolve(&mut encoder).expect("to resolve");
        gpu.submit(encoder);
    }
    for count in [2, 0, 1] {
        let start = Instant::now();
        let spans = loop {
            match timer.try_read().expect("timestamps") {
                Some(spans) => break spans,
                None => assert!(start.elapsed() < Duration::from_secs(60), "they never come"),
            }
        };
        assert_eq!(spans.len(), count);
        assert!(spans.iter().all(|span| *span > Duration::ZERO), "{spans:?}");
    }
    // Timestamps that were not submitted are reported as such and can be read later.
    let mut encoder = gpu.encoder();
    bound.encode_timed(&mut encoder, &mut timer).expect("to encode");
    timer.resolve(&mut encoder).expect("to resolve");
    assert!(matches!(timer.read(), Err(Error::TimerNotSubmitted)));
    gpu.submit(encoder);
    assert_eq!(timer.read().expect("timestamps").len(), 1);
}

#[test]
fn a_timer_needs_its_feature_and_a_sensible_capacity() {
    let plain = Gpu::new();
    let error = Timer::new(&plain.device, &plain.queue, 1).expect_err("no feature");
    assert!(error.to_string().contains("TIMESTAMP_QUERY"), "{error}");
    let gpu = timing_gpu();
    for capacity in [0, Timer::MAX_CAPACITY + 1] {
        let error = Timer::new(&gpu.device, &gpu.queue, capacity).expect_err("a bad capacity");
        assert!(
            matches!(error, Error::TimerCapacity { asked, .. } if asked == capacity),
            "{error}"
        );
    }
    Timer::new(&gpu.device, &gpu.queue, Timer::MAX_CAPACITY).expect("the largest timer");
}

#[test]
fn a_full_timer_records_nothing() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 1).expect("a timer");
    let pass = pass(&gpu, Stage::Compute);
    let color = view(&gpu.upload([4, 4], 1, &ramp([4, 4], 1)));
    let target = gpu.target([4, 4]);
    let mut encoder = gpu.encoder();
    pass.bind(&[("color", &color)], &view(&target))
        .expect("to bind")
        .encode_timed(&mut encoder, &mut timer)
        .expect("to encode");
    let other = gpu.target([4, 4]);
    let error = pass
        .bind(&[("color", &color)], &view(&other))
        .expect("to bind")
        .encode_timed(&mut encoder, &mut timer)
        .expect_err("a full timer");
    assert!(matches!(error, Error::TimerFull { capacity: 1 }), "{error}");
    timer.resolve(&mut encoder).expect("to resolve");
    gpu.submit(encoder);
    assert_eq!(timer.read().expect("timestamps").len(), 1);
    assert_eq!(gpu.download(&target), ramp([4, 4], 1));
    assert_eq!(gpu.download(&other), [[0.0; 4]; 16]);
}

#[test]
fn reading_too_early_is_an_error_and_can_be_tried_again() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 1).expect("a timer");
    assert!(matches!(timer.read(), Err(Error::TimerNotResolved)));
    let pass = pass(&gpu, Stage::Fragment);
    let color = view(&gpu.upload([4, 4], 1, &ramp([4, 4], 1)));
    let mut encoder = gpu.encoder();
    pass.bind(&[("color", &color)], &view(&gpu.target([4, 4])))
        .expect("to bind")
        .encode_timed(&mut encoder, &mut timer)
        .expect("to encode");
    timer.resolve(&mut encoder).expect("to resolve");
    assert!(matches!(timer.read(), Err(Error::TimerNotSubmitted)));
    gpu.submit(encoder);
    assert_eq!(timer.read().expect("timestamps").len(), 1);
}

#[test]
fn a_span_that_was_not_used_is_not_read_as_a_time() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 2).expect("a timer");
    let pass = pass(&gpu, Stage::Compute);
    let color = view(&gpu.upload([4, 4], 1, &ramp([4, 4], 1)));
    let mut encoder = gpu.encoder();
    pass.bind(&[("color", &color)], &view(&gpu.target([4, 4])))
        .expect("to bind")
        .encode_timed(&mut encoder, &mut timer)
        .expect("to encode");
    timer.span().expect("a span that nothing uses");
    timer.resolve(&mut encoder).expect("to resolve");
    gpu.submit(encoder);
    assert!(matches!(timer.read(), Err(Error::TimerNotSubmitted)));
}

#[test]
fn a_timer_of_a_lost_device_says_so() {
    let gpu = timing_gpu();
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 1).expect("a timer");
    let mut encoder = gpu.encoder();
    gpu.device.destroy();
    assert!(matches!(timer.resolve(&mut encoder), Err(Error::DeviceLost { .. })));
    assert!(matches!(timer.read(), Err(Error::DeviceLost { .. })));
    assert!(matches!(
        Timer::new(&gpu.device, &gpu.queue, 1),
        Err(Error::DeviceLost { .. })
    ));
}
