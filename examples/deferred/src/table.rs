//! A comparison of all choices: how close each comes to 256 samples a pixel, and what a frame takes.

use crate::antialiasing::Antialiasing;
use crate::gpu::Gpu;
use crate::renderer::Renderer;
use crate::{Failure, Size, picture};
use std::fmt;
use std::time::{Duration, Instant};
use straightline_sraa::wgpu;

/// Frames of each choice that are timed, all choices in turn.
const ROUNDS: usize = 15;

pub struct Table {
    /// Description of the frame and of the clock.
    title: String,
    rows: Vec<Row>,
}

/// One choice. Times are medians.
pub struct Row {
    pub antialiasing: Antialiasing,
    pub db: f64,
    /// Time until a frame is done, by the wall clock.
    pub frame: Duration,
    /// By the GPU's timestamps: the passes of a frame, and SRAA alone. `None` if there are none that can be trusted.
    pub device: Option<(Duration, Option<Duration>)>,
}

/// Compares the frames at `time` seconds.
pub fn compare(gpu: &Gpu, renderer: &mut Renderer, size: Size, time: f32) -> Result<Table, Failure> {
    let target = picture::target(gpu, size);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let [mut frames, mut devices, mut sraas] = [(); 3].map(|()| Antialiasing::ALL.map(|_| Vec::new()));
    for _ in 0..ROUNDS {
        for (k, (antialiasing, _)) in Antialiasing::ALL.into_iter().enumerate() {
            // Untimed, as it binds SRAA, and the driver may compile.
            draw_one(gpu, renderer, time, antialiasing, &view)?;
            renderer.clock.take()?;
            frames[k].push(draw_one(gpu, renderer, time, antialiasing, &view)?);
            if let Some((all, of_sraa)) = renderer.clock.take()?.and_then(|costs| costs.device) {
                devices[k].push(all);
                sraas[k].extend(of_sraa);
            }
        }
    }
    renderer.draw_reference(time, &view)?;
    let reference = pollster::block_on(picture::read(gpu, &target))?;
    let mut rows = Vec::new();
    for (k, (antialiasing, _)) in Antialiasing::ALL.into_iter().enumerate() {
        let drawn = pollster::block_on(picture::draw(gpu, renderer, size, time, antialiasing))?;
        rows.push(Row {
            antialiasing,
            db: psnr(&drawn, &reference),
            frame: median(&mut frames[k]).ok_or("no frame was timed")?,
            device: median(&mut devices[k]).map(|all| (all, median(&mut sraas[k]))),
        });
    }
    let [width, height] = size;
    let title = format!("{width}x{height} at second {time}, {}, {}", gpu.adapter.get_info().name, gpu.clock());
    Ok(Table { title, rows })
}

/// Draws a frame, and waits until it is done.
fn draw_one(
    gpu: &Gpu,
    renderer: &mut Renderer,
    time: f32,
    antialiasing: Antialiasing,
    target: &wgpu::TextureView,
) -> Result<Duration, Failure> {
    let begun = Instant::now();
    renderer.draw(time, antialiasing, target)?;
    gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(begun.elapsed())
}

fn median(times: &mut [Duration]) -> Option<Duration> {
    times.sort();
    times.get(times.len() / 2).copied()
}

/// Peak signal-to-noise ratio of displayed colours, in linear light from 0 to 1.
fn psnr(picture: &[u8], reference: &[u8]) -> f64 {
    let linear = |byte: u8| {
        let v = f64::from(byte) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    };
    let colours = picture.iter().zip(reference).enumerate().filter(|(k, _)| k % 4 != 3);
    let squares: Vec<f64> = colours.map(|(_, (a, b))| (linear(*a) - linear(*b)).powi(2)).collect();
    -10.0 * (squares.iter().sum::<f64>() / squares.len() as f64).log10()
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = |time: Duration| format!("{:.2}", time.as_secs_f64() * 1e3);
        let has_timestamps = self.rows.iter().any(|row| row.device.is_some());
        writeln!(f, "{}\n", self.title)?;
        let (titles, rule) = match has_timestamps {
            true => (" GPU, ms | SRAA, ms |", " ------: | -------: |"),
            false => ("", ""),
        };
        writeln!(f, "| preset |    dB | a frame, ms |{titles}\n| :----- | ----: | ----------: |{rule}")?;
        for (k, row) in self.rows.iter().enumerate() {
            let end = if k + 1 < self.rows.len() { "\n" } else { "" };
            write!(f, "| {:6} | {:5.2} | {:>11} |", row.antialiasing, row.db, ms(row.frame))?;
            if has_timestamps {
                let [all, sraa] = [row.device.map(|(all, _)| all), row.device.and_then(|(_, sraa)| sraa)];
                let [all, sraa] = [all, sraa].map(|time| time.map_or("–".to_owned(), ms));
                write!(f, " {all:>7} | {sraa:>8} |")?;
            }
            write!(f, "{end}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_approach_supersampling_in_their_order() {
        let gpu = pollster::block_on(Gpu::headless(false)).unwrap();
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, [320, 180], picture::FORMAT).unwrap();
        let table = compare(&gpu, &mut renderer, [320, 180], 2.0).unwrap();
        println!("{table}");
        let db: Vec<f64> = table.rows.iter().map(|row| row.db).collect();
        let [none, paper, fast, edges, full, guided, supersampled] = db[..] else { panic!("seven choices") };
        assert!(paper > none + 3.0 && fast > none + 3.0);
        assert!(edges > paper + 0.5 && full > edges + 0.2 && guided > full + 1.0);
        assert!(guided > supersampled - 0.5);
        assert_eq!(table.to_string().lines().count(), 4 + Antialiasing::ALL.len());
    }
}
