//! Times of bound passes that run in turn.

use crate::guard::run_guarded;
use crate::{Bound, Error, Timer};
use std::time::Duration;
use web_time::Instant;
use wgpu::{CommandEncoderDescriptor, Device, DeviceType, Features, Queue};

/// Time after which no further round begins.
const BUDGET: Duration = Duration::from_secs(1);

/// Fewest and most rounds.
const ROUNDS: std::ops::RangeInclusive<usize> = 3..=32;

/// Shortest measurement by the clock, so that submitting is a small part of it.
const LONG_ENOUGH: Duration = Duration::from_millis(2);

/// Most runs of a pass in one measurement by the clock.
const MAX_RUNS: u32 = 16;

/// Ratio to the first candidate's time at which another candidate is preferred.
const CLEARLY_FASTER: f64 = 0.98;

/// Returns the milliseconds of each pass, round by round. The first run of each, in which drivers compile, is left out.
pub(super) fn time_in_turn(device: &Device, queue: &Queue, bound: &[Bound]) -> Result<Vec<Vec<f64>>, Error> {
    // A software driver runs passes on the CPU, where the clock is exact, and lavapipe's timestamps are not.
    let has_timestamps = device.features().contains(Features::TIMESTAMP_QUERY);
    let mut timer = match has_timestamps && device.adapter_info().device_type != DeviceType::Cpu {
        true => Some(Timer::new(device, queue, 1)?),
        false => None,
    };
    let mut runs = Vec::new();
    for each in bound {
        run(device, queue, each, 1)?;
        let once = run(device, queue, each, 1)?;
        let needed = LONG_ENOUGH.as_secs_f64() / once.as_secs_f64().max(1e-6);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        runs.push(needed.ceil().clamp(1.0, f64::from(MAX_RUNS)) as u32);
    }
    let start = Instant::now();
    let mut times = vec![Vec::new(); bound.len()];
    for round in 0..*ROUNDS.end() {
        if round >= *ROUNDS.start() && start.elapsed() > BUDGET {
            break;
        }
        for ((each, times), runs) in bound.iter().zip(&mut times).zip(&runs) {
            let time = match &mut timer {
                Some(timer) => run_timed(device, queue, each, timer)?,
                None => run(device, queue, each, *runs)? / *runs,
            };
            times.push(1000.0 * time.as_secs_f64());
        }
    }
    Ok(times)
}

/// Runs a pass several times, waits, and returns the time of all by the clock.
fn run(device: &Device, queue: &Queue, bound: &Bound, runs: u32) -> Result<Duration, Error> {
    let start = Instant::now();
    submit(device, queue, |encoder| {
        for _ in 0..runs {
            bound.encode(encoder);
        }
        Ok(())
    })?;
    let waited = device.poll(wgpu::PollType::wait_indefinitely());
    waited.map_err(|error| Error::TimerRead {
        description: error.to_string(),
    })?;
    Ok(start.elapsed())
}

/// Runs a pass once, and returns its time on the GPU.
fn run_timed(device: &Device, queue: &Queue, bound: &Bound, timer: &mut Timer) -> Result<Duration, Error> {
    submit(device, queue, |encoder| {
        bound.encode_timed(encoder, timer)?;
        timer.resolve(encoder)
    })?;
    Ok(timer.read()?.into_iter().sum())
}

/// Records commands and submits them. An error of wgpu is returned, and does not reach the device's handler.
fn submit(
    device: &Device,
    queue: &Queue,
    record: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<(), Error>,
) -> Result<(), Error> {
    let failed = |description| Error::TimerRead { description };
    run_guarded(device, "timing the candidates of a shader", failed, || {
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
        record(&mut encoder)?;
        queue.submit([encoder.finish()]);
        Ok(())
    })?
}

/// Returns the candidate with the smallest median, or the first one unless another is clearly faster.
pub(super) fn find_fastest(rounds: &[Vec<f64>]) -> usize {
    let medians: Vec<f64> = rounds.iter().map(|times| median(times)).collect();
    let fastest = (0..medians.len()).min_by(|a, b| medians[*a].total_cmp(&medians[*b]));
    let fastest = fastest.unwrap_or(0);
    // Each ratio is of one round, so that load beside the program acts on both.
    let ratios = rounds[fastest].iter().zip(&rounds[0]).map(|(time, first)| time / first);
    match median(&ratios.collect::<Vec<_>>()) < CLEARLY_FASTER {
        true => fastest,
        false => 0,
    }
}

/// The middle value, or the upper one of two.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::find_fastest;

    #[test]
    fn the_first_form_stays_unless_another_is_clearly_faster() {
        assert_eq!(find_fastest(&[vec![1.0, 1.1, 0.9], vec![0.99, 1.09, 0.89]]), 0);
        assert_eq!(
            find_fastest(&[vec![1.0, 1.1, 0.9], vec![2.0, 2.0, 2.0], vec![0.5, 0.6, 0.5]]),
            2
        );
        assert_eq!(find_fastest(&[vec![1.0]]), 0);
    }

    #[test]
    fn load_beside_the_program_acts_on_both() {
        // The second candidate is 10 % faster in each round, though its times vary more than that.
        let first = [1.0, 4.0, 1.2, 2.0, 1.1];
        let second = first.map(|time| 0.9 * time);
        assert_eq!(find_fastest(&[first.to_vec(), second.to_vec()]), 1);
    }
}
