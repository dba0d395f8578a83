//! Kernels that change while the program runs: other pixels, or a message and the old ones.

use crate::common::{self, ramp, view};

use common::{COPY, Fixture, Gpu, STAGES, Stage};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use straightline_runtime::{BindOptions, Bound, Error, KernelConfig, Pass, PassOptions, Reloading, wgpu};

const SIZE: [u32; 2] = [5, 3];

/// A folder with a kernel, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("straightline-reload-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("to write");
        path
    }

    /// Writes a kernel with these parameters and this result.
    fn kernel(&self, parameters: &str, result: &str) -> PathBuf {
        let text = format!("pub fn tint(color: &Frame<Vec4>, {parameters}pixel: IVec2) -> Vec4 {{\n    {result}\n}}\n");
        self.write("tint.rs", &text)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).expect("to remove the folder");
    }
}

fn config(path: &Path, stage: Stage) -> KernelConfig {
    KernelConfig::from_file(path)
        .stage(stage)
        .format(straightline_runtime::manifest::Format::Rgba32Float)
}

fn start(gpu: &Gpu, config: KernelConfig) -> Result<Reloading, Error> {
    let reloading = Reloading::new(&gpu.device, config, &PassOptions::default())?;
    Ok(reloading.interval(Duration::ZERO))
}

/// Polls until there is a change or an error, as frames do.
fn wait(reloading: &mut Reloading) -> Result<(), Error> {
    let start = Instant::now();
    while !reloading.poll()? {
        assert!(start.elapsed() < Duration::from_secs(60), "no change was seen");
        std::thread::sleep(Duration::from_millis(1));
    }
    Ok(())
}

/// Records `bound`, and compares each component of the target with `wanted` of the ramp's.
fn check(gpu: &Gpu, bound: &Bound, target: &wgpu::Texture, wanted: impl Fn(f32) -> f32) {
    let mut encoder = gpu.encoder();
    bound.encode(&mut encoder);
    gpu.submit(encoder);
    let wanted: Vec<[f32; 4]> = ramp(SIZE, 1).iter().map(|pixel| pixel.map(&wanted)).collect();
    assert_eq!(gpu.download(target), wanted);
}

#[test]
fn a_changed_kernel_draws_other_pixels() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let folder = Folder::new(stage.name());
        let path = folder.kernel("gain: f32, ", "color.load(pixel) * gain");
        let mut reloading = start(&gpu, config(&path, stage)).expect("a pass");
        let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
        let options = BindOptions::default().uniform("gain", 2.0);
        let mut bound = reloading
            .pass()
            .bind_with(&[("color", &color)], &view(&target), &options)
            .expect("to bind");
        check(&gpu, &bound, &target, |x| x * 2.0);
        assert!(!reloading.poll().expect("no change"));

        folder.kernel("gain: f32, ", "color.load(pixel) * gain + 1.0");
        wait(&mut reloading).expect("a good kernel");
        check(&gpu, &bound, &target, |x| x * 2.0);
        reloading.renew(&mut bound).expect("its own");
        check(&gpu, &bound, &target, |x| x * 2.0 + 1.0);

        // An error, reported once.
        folder.kernel("gain: f32, ", "color.load(pixel) * gian");
        let error = wait(&mut reloading).expect_err("a faulty kernel");
        let message = error.to_string();
        assert!(matches!(error, Error::Generate { .. }), "{message}");
        let place = format!("{}:2:25", path.display());
        assert!(message.starts_with("error[E") && message.contains("gian"), "{message}");
        assert!(message.contains(&place), "{message}");
        assert!(!reloading.poll().expect("reported once"));
        check(&gpu, &bound, &target, |x| x * 2.0 + 1.0);

        for (parameters, result, wanted) in [
            (
                "mask: &Frame<Vec4>, gain: f32, ",
                "color.load(pixel) * gain * mask.load(pixel)",
                "input `mask` is new",
            ),
            ("", "color.load(pixel) * 3.0", "uniform `gain` is no longer there"),
            (
                "gain: Vec4, ",
                "color.load(pixel) * gain",
                "uniform `gain` has another type, place or format",
            ),
            (
                "gain: f32, bias: f32, ",
                "color.load(pixel) * gain + bias",
                "uniform `bias` is new",
            ),
        ] {
            folder.kernel(parameters, result);
            let error = wait(&mut reloading).expect_err("other bindings");
            assert!(matches!(error, Error::Changed { .. }), "{error}");
            let message = "`tint` was changed and binds other resources: ";
            assert_eq!(
                error.to_string(),
                format!("{message}{wanted}; restart the program for this change")
            );
            check(&gpu, &bound, &target, |x| x * 2.0 + 1.0);
        }

        folder.kernel("gain: f32, ", "(color.load(pixel) - 1.0) * gain");
        wait(&mut reloading).expect("a good kernel");
        reloading.renew(&mut bound).expect("its own");
        bound.write_uniform(&gpu.queue, "gain", 4.0).expect("a uniform");
        check(&gpu, &bound, &target, |x| (x - 1.0) * 4.0);
    }
}

#[test]
fn further_files_are_watched() {
    let gpu = Gpu::new();
    let folder = Folder::new("files");
    let more = folder.write("more.rs", "pub fn change(x: Vec4) -> Vec4 { x + 1.0 }\n");
    let path = folder.kernel("", "change(color.load(pixel))");
    let mut reloading = start(&gpu, config(&path, Stage::Compute).source(&more)).expect("a pass");
    let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
    let mut bound = reloading
        .pass()
        .bind(&[("color", &color)], &view(&target))
        .expect("to bind");
    check(&gpu, &bound, &target, |x| x + 1.0);
    folder.write("more.rs", "pub fn change(x: Vec4) -> Vec4 { 0.5 * x }\n");
    wait(&mut reloading).expect("a good kernel");
    reloading.renew(&mut bound).expect("its own");
    check(&gpu, &bound, &target, |x| 0.5 * x);
    // A file that has gone is an error of the kernel, and its return a change.
    std::fs::remove_file(&more).expect("to remove");
    let error = wait(&mut reloading).expect_err("a missing file").to_string();
    assert!(
        error.contains("cannot read the kernel file") && error.contains("more.rs"),
        "{error}"
    );
    folder.write("more.rs", "pub fn change(x: Vec4) -> Vec4 { x }\n");
    wait(&mut reloading).expect("a good kernel");
}

#[test]
fn files_are_looked_at_now_and_then() {
    let gpu = Gpu::new();
    let folder = Folder::new("interval");
    let path = folder.kernel("", "color.load(pixel)");
    let reloading = start(&gpu, config(&path, Stage::Compute)).expect("a pass");
    let mut reloading = reloading.interval(Duration::from_secs(3600));
    folder.kernel("", "color.load(pixel) * 2.0");
    for _ in 0..50 {
        assert!(!reloading.poll().expect("no look"));
        std::thread::sleep(Duration::from_millis(10));
    }
    wait(&mut reloading.interval(Duration::ZERO)).expect("a good kernel");
}

#[test]
fn what_cannot_be_reloaded_is_refused() {
    let gpu = Gpu::new();
    let folder = Folder::new("refused");
    let path = folder.kernel("", "color.load(pixel) * 2.0");
    let reloading = start(&gpu, config(&path, Stage::Compute)).expect("a pass");
    let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Compute);
    let other = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
    let mut bound = other.bind(&[("color", &color)], &view(&target)).expect("to bind");
    let error = reloading.renew(&mut bound).expect_err("another pass");
    assert_eq!(
        error.to_string(),
        "a binding of `copy` was given to renew, and it was not made by the `Reloading` of `tint`"
    );
    check(&gpu, &bound, &target, |x| x);

    let chain = "pub fn glow(color: &Texture<Vec4>) -> Texture<Vec4> {
        draw(color.size(), |pixel| color.load(pixel) * 2.0)
    }";
    let chain = folder.write("glow.rs", chain);
    let error = start(&gpu, config(&chain, Stage::Compute))
        .expect_err("a chain")
        .to_string();
    assert!(
        error.starts_with("`glow` is a chain, a set of variants or of candidates"),
        "{error}"
    );
    let missing = start(&gpu, config(&folder.0.join("none.rs"), Stage::Compute)).expect_err("no file");
    assert!(missing.to_string().contains("cannot read the kernel file"), "{missing}");
}
