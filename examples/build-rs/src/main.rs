//! Adds a glow to the bright areas of a picture, and writes `glow.png`. `glow.choices.txt` remembers which shader is fastest.
//!
//! `cargo run [--release] [PICTURE.png] [--cpu]`: without a picture, a test picture is generated. With `--cpu` the kernel runs as
//! rustc compiled it, otherwise as the generated shader.

mod gpu;
mod kernels {
    pub mod glow;
}

/// Output of `build.rs`: a module for each kernel.
mod shaders {
    straightline_runtime::include_shaders!();
}

use kernels::glow::{Glow, glow};
use std::path::Path;
use straightline_kernels::prelude::*;
use straightline_runtime::Choices;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (flags, paths): (Vec<String>, Vec<String>) = std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let picture = match paths.first() {
        Some(path) => read(path)?,
        None => discs(uvec2(640, 360)),
    };
    let cfg = Glow { strength: 1.5, ..Glow::default() };
    let glowing = if flags.iter().any(|f| f == "--cpu") {
        native(&cfg, &picture)
    } else {
        let file = Path::new("glow.choices.txt");
        let mut choices = Choices::read(file).unwrap_or_default();
        let glowing = gpu::glow(&picture, cfg.strength, &mut choices)?;
        choices.write(file)?;
        glowing
    };
    write("glow.png", &glowing)?;
    println!("glow.png");
    Ok(())
}

/// Runs the kernel natively, pixel by pixel.
fn native(cfg: &Glow, picture: &Frame<Vec4>) -> Frame<Vec4> {
    let size = picture.size();
    let pixels = (0..size.y as i32).flat_map(|y| (0..size.x as i32).map(move |x| ivec2(x, y)));
    Frame::new(size, pixels.map(|pixel| glow(cfg, picture, pixel)).collect())
}

/// Bright discs on a dark background.
fn discs(size: UVec2) -> Frame<Vec4> {
    let shade = |x: u32, y: u32| {
        let cell = vec2((x % 80) as f32 - 40.0, (y % 72) as f32 - 36.0);
        let hue = vec3((x / 80) as f32 / 7.0, (y / 72) as f32 / 4.0, 1.0 - (x / 80) as f32 / 7.0);
        if cell.length() < 14.0 { (0.5 + 0.5 * hue).extend(1.0) } else { vec4(0.02, 0.02, 0.05, 1.0) }
    };
    Frame::new(size, (0..size.y).flat_map(|y| (0..size.x).map(move |x| shade(x, y))).collect())
}

fn read(path: &str) -> Result<Frame<Vec4>, image::ImageError> {
    let picture = image::open(path)?.to_rgba32f();
    let texels = picture.pixels().map(|p| Vec4::from_array(p.0)).collect();
    Ok(Frame::new(uvec2(picture.width(), picture.height()), texels))
}

fn write(path: &str, picture: &Frame<Vec4>) -> Result<(), image::ImageError> {
    let size = picture.size();
    let bytes = picture.texels().iter().flat_map(|c| c.to_array()).map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    image::save_buffer(path, &bytes.collect::<Vec<u8>>(), size.x, size.y, image::ColorType::Rgba8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel as rustc compiles it is the reference for the generated shader.
    #[test]
    fn shader_and_kernel_agree() {
        let picture = discs(uvec2(161, 73));
        let cfg = Glow { strength: 1.5, ..Glow::default() };
        let shader = gpu::glow(&picture, cfg.strength, &mut Choices::new())
            .expect("an adapter; a software one is in Debian's mesa-vulkan-drivers");
        for (k, (a, b)) in native(&cfg, &picture).texels().iter().zip(shader.texels()).enumerate() {
            // The shader writes halves.
            assert!((*a - *b).abs().max_element() < 1.0e-3, "pixel {k}: {a} and {b}");
        }
    }
}
