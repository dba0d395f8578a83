//! A small deferred renderer with Subpixel Reconstruction Antialiasing.
//!
//! `cargo run` opens a window: digits choose a preset of SRAA, Space returns to the choice before, Escape closes the window.
//! `cargo run -- --preset full --out picture.png` needs no window, nor does `--table`, which compares all presets. `--size 1280x720`
//! and `--time 2.5` select the picture, `--timestamps` enables those of software drivers as well. `web/build` builds a web page.
//!
//! Files: `renderer/` has the passes of a frame, `scene.rs` the scene, `antialiasing.rs` the presets, `window.rs`, `web.rs`,
//! `picture.rs` and `table.rs` the outputs, `clock.rs` the frame times.

mod antialiasing;
mod clock;
mod gpu;
mod options;
mod picture;
mod renderer;
mod scene;
#[cfg(not(target_arch = "wasm32"))]
mod table;
#[cfg(target_arch = "wasm32")]
mod web;
#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
mod window;

/// Any error, to be displayed.
type Failure = Box<dyn std::error::Error>;

/// Width and height in pixels.
type Size = [u32; 2];

#[cfg(target_arch = "wasm32")]
fn main() {
    web::start();
}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> Result<(), Failure> {
    let options = options::Options::parse(std::env::args().skip(1))?;
    if options.out.is_some() || options.table {
        return without_window(&options);
    }
    #[cfg(feature = "window")]
    return window::run(&options);
    #[cfg(not(feature = "window"))]
    Err("built without the feature `window`: use --out FILE.png or --table".into())
}

/// Saves a picture, prints the table, or both.
#[cfg(not(target_arch = "wasm32"))]
fn without_window(options: &options::Options) -> Result<(), Failure> {
    let gpu = pollster::block_on(gpu::Gpu::headless(options.timestamps))?;
    let time = options.time.unwrap_or(2.0);
    let mut renderer = renderer::Renderer::new(&gpu.device, &gpu.queue, options.size, picture::FORMAT)?;
    if let Some(path) = &options.out {
        let [width, height] = options.size;
        let drawn = picture::draw(&gpu, &mut renderer, options.size, time, options.antialiasing);
        image::save_buffer(path, &pollster::block_on(drawn)?, width, height, image::ColorType::Rgba8)?;
        println!("{path}: {}", options.antialiasing);
    }
    if options.table {
        println!("{}", table::compare(&gpu, &mut renderer, options.size, time)?);
    }
    Ok(())
}
