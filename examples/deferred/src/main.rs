//! A small deferred renderer with Subpixel Reconstruction Antialiasing in it.
//!
//! `cargo run` opens a window: Space turns SRAA on and off, Escape closes it. `cargo run -- --out picture.png` needs no
//! window: `--size 1280x720`, `--time 2.5` and `--without-sraa` say what to draw.
//!
//! To read: `renderer.rs` has the four passes of a frame in order, `scene.rs` what is drawn, `window.rs` and
//! `picture.rs` where it goes.

mod picture;
mod renderer;
mod scene;
#[cfg(feature = "window")]
mod window;

/// What `build.rs` made: a module for each kernel.
mod shaders {
    straightline_runtime::include_shaders!();
}

/// Whatever went wrong, to be shown.
type Failure = Box<dyn std::error::Error>;

/// Width and height in pixels.
type Size = [u32; 2];

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let (mut out, mut size, mut time, mut sraa) = (None, [960, 540], 2.0, true);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--out" => out = Some(value()?),
            "--size" => size = parse_size(&value()?)?,
            "--time" => time = value()?.parse()?,
            "--without-sraa" => sraa = false,
            _ => {
                return Err(format!("no option {argument}: there are --out, --size, --time and --without-sraa").into());
            }
        }
    }
    match out {
        Some(path) => {
            let pixels = picture::draw(size, time, sraa)?;
            image::save_buffer(&path, &pixels, size[0], size[1], image::ColorType::Rgba8)?;
            println!("{path}");
            Ok(())
        }
        #[cfg(feature = "window")]
        None => window::run(size, sraa),
        #[cfg(not(feature = "window"))]
        None => Err("built without the feature `window`: name a picture with --out FILE.png".into()),
    }
}

fn parse_size(text: &str) -> Result<Size, Failure> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(size) if size.iter().all(|side| (1..=8192).contains(side)) => Ok(size),
        _ => Err(format!("{text} is not a size such as 1280x720, up to 8192x8192").into()),
    }
}
