//! The kernel generated again whenever its file changes.

use crate::shaders::lens::Inputs;
use std::error::Error;
use std::time::Duration;
use straightline_runtime::{BindOptions, Bound, KernelConfig, PassOptions, Reloading, Resource, wgpu};

/// The kernel's file, wherever the program is started.
const KERNEL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/kernels/lens.rs");

/// Calls `write` after each change of the kernel, and prints its errors. Does not return.
pub fn watch(
    device: &wgpu::Device,
    inputs: &Inputs<'_>,
    strength: f32,
    target: &wgpu::TextureView,
    write: impl Fn(&Bound) -> Result<(), Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let mut lens = Reloading::new(device, KernelConfig::from_file(KERNEL), &PassOptions::default())?;
    let inputs = [("image", Resource::from(inputs.image)), ("linear", inputs.linear.into())];
    let options = BindOptions::default().uniform("strength", strength);
    let mut bound = lens.pass().bind_with(&inputs, target, &options)?;
    println!("change {KERNEL}; Ctrl-C ends");
    // Once a frame, in a renderer.
    loop {
        match lens.poll() {
            Ok(true) => {
                lens.renew(&mut bound)?;
                write(&bound)?;
                println!("written");
            }
            Ok(false) => std::thread::sleep(Duration::from_millis(20)),
            Err(error) => eprintln!("{error}"),
        }
    }
}
