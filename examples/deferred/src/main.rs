//! A small deferred renderer with Subpixel Reconstruction Antialiasing.
//!
//! `cargo run` opens a window: Space toggles SRAA, P, S, D and H its extensions, Escape closes the window. `cargo run -- --out
//! picture.png` needs no window: `--size 1280x720`, `--time 2.5`, `--without-sraa` and `--without-placing` select the picture,
//! `--timestamps` enables those of software drivers as well. `web/build` builds a web page.
//!
//! Files: `renderer.rs` has the passes of a frame in order, `scene.rs` the scene, `window.rs`, `web.rs` and
//! `picture.rs` the outputs, `clock.rs` the frame times.

mod clock;
mod gpu;
mod options;
mod picture;
mod renderer;
mod scene;
#[cfg(target_arch = "wasm32")]
mod web;
#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
mod window;

/// Output of `build.rs`: a module for each kernel.
mod shaders {
    straightline_runtime::include_shaders!();
}

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
    match &options.out {
        Some(path) => save(path, &options),
        #[cfg(feature = "window")]
        None => window::run(&options),
        #[cfg(not(feature = "window"))]
        None => Err("built without the feature `window`: name a picture with --out FILE.png".into()),
    }
}

/// Saves a picture, and prints the time that such frames take.
#[cfg(not(target_arch = "wasm32"))]
fn save(path: &str, options: &options::Options) -> Result<(), Failure> {
    let gpu = pollster::block_on(gpu::Gpu::headless(options.timestamps))?;
    let time = options.time.unwrap_or(2.0);
    let mut renderer = renderer::Renderer::new(&gpu.device, &gpu.queue, options.size, picture::FORMAT)?;
    let pixels = pollster::block_on(picture::draw(&gpu, &mut renderer, options.size, time, options.parts))?;
    image::save_buffer(path, &pixels, options.size[0], options.size[1], image::ColorType::Rgba8)?;
    // The previous frame includes the drivers' compilation.
    renderer.clock.take()?;
    let target = picture::target(&gpu, options.size).create_view(&Default::default());
    let mut until_done = Vec::new();
    for _ in 0..FRAMES {
        let begun = web_time::Instant::now();
        renderer.draw(time, options.parts, &target)?;
        gpu.device.poll(straightline_runtime::wgpu::PollType::wait_indefinitely())?;
        until_done.push(begun.elapsed());
    }
    until_done.sort();
    println!("{path}");
    if let Some(costs) = renderer.clock.take()? {
        let median = until_done[FRAMES / 2].as_secs_f64() * 1e3;
        println!("a frame, of {FRAMES}: {costs}; {median:.2} ms until it is done, {}", gpu.clock());
    }
    Ok(())
}

/// Number of frames that are timed one by one.
#[cfg(not(target_arch = "wasm32"))]
const FRAMES: usize = 15;
