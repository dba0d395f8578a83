//! Pipeline caches in files: found again, and replaced where they cannot be used.

use crate::common::{self, chains, ramp, view};

use chains::{BLEND, DOWN, glow};
use common::{COPY, Fixture, Gpu, STAGES, Stage};
use std::path::{Path, PathBuf};
use straightline_runtime::manifest::hash_of_bytes;
use straightline_runtime::{
    CacheOrigin, Chain, Draw, DrawOptions, Error, Pass, PassOptions, PipelineCacheFile, Shader,
};
use straightline_runtime::{Passes, wgpu};
use wgpu::Features;

const SIZE: [u32; 2] = [5, 3];

/// A folder of a test's own, removed in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("straightline-cache-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("a folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("an entry").file_name();
        entries
            .map(|entry| name(entry).to_string_lossy().into_owned())
            .collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).expect("to remove the folder");
    }
}

fn gpu() -> Gpu {
    Gpu::with(Features::PIPELINE_CACHE, wgpu::Limits::default())
}

#[allow(unsafe_code)]
fn open(gpu: &Gpu, folder: &Path) -> PipelineCacheFile {
    // SAFETY: only these tests write to their folders, and their forged files are refused before a driver sees them.
    unsafe { PipelineCacheFile::open(&gpu.device, folder) }
}

fn make(gpu: &Gpu, stage: Stage, file: &PipelineCacheFile) -> Result<Pass, Error> {
    let Fixture { manifest, wgsl } = COPY.emit(stage);
    let shader = Shader::from_json(&manifest, &wgsl).expect("a shader");
    Pass::from_shader(
        &gpu.device,
        &shader,
        &PassOptions::default().pipeline_cache(file.cache()),
    )
}

/// Runs the pass, and compares the picture.
fn check(gpu: &Gpu, pass: &Pass) {
    let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
    let mut encoder = gpu.encoder();
    pass.bind(&[("color", &color)], &view(&target))
        .expect("to bind")
        .encode(&mut encoder);
    gpu.submit(encoder);
    assert_eq!(gpu.download(&target), ramp(SIZE, 1));
}

#[test]
fn a_cache_is_found_by_the_next_run() {
    let folder = Folder::new("found");
    let below = folder.0.join("of/this/program");
    for wanted in [CacheOrigin::New, CacheOrigin::File, CacheOrigin::File] {
        let gpu = gpu();
        let file = open(&gpu, &below);
        assert_eq!(*file.origin(), wanted);
        for stage in STAGES {
            check(&gpu, &make(&gpu, stage, &file).expect("a pass"));
        }
        file.save().expect("to save");
        assert!(
            file.path()
                .is_some_and(|path| path.starts_with(&below) && path.is_file())
        );
    }
    // One file, and no unfinished one beside it.
    assert_eq!(std::fs::read_dir(&below).expect("a folder").count(), 1);
}

#[test]
fn a_file_that_cannot_be_used_is_replaced() {
    let folder = Folder::new("replaced");
    let gpu = gpu();
    let file = open(&gpu, &folder.0);
    make(&gpu, Stage::Compute, &file).expect("a pass");
    file.save().expect("to save");
    let path = file.path().expect("a file");
    let good = std::fs::read(path).expect("the file");
    let hashed = |data: &[u8]| [hash_of_bytes(data).as_bytes(), data].concat();
    let changed = |at: usize| {
        let mut bytes = good.clone();
        bytes[at] ^= 1;
        bytes
    };
    let damaged = "it is damaged";
    let (header, vendor) = (16, 16 + 8 + 4 + 4 + 1 + 3);
    for (bytes, wanted) in [
        (Vec::new(), damaged),
        (b"not a cache".to_vec(), damaged),
        (good[..good.len() - 1].to_vec(), damaged),
        (changed(0), damaged),
        (changed(good.len() - 1), damaged),
        // The hash is right, and wgpu's header is not.
        (hashed(&good[header..good.len() - 1]), "truncated"),
        (hashed(&[&good[header..], b"x"].concat()), "longer"),
        (hashed(&changed(header)[header..]), "corrupted"),
        (hashed(&changed(vendor)[header..]), "different device"),
    ] {
        std::fs::write(path, &bytes).expect("to write");
        let file = open(&gpu, &folder.0);
        let CacheOrigin::Replaced { reason } = file.origin() else {
            panic!("{:?} for {wanted}", file.origin());
        };
        assert!(reason.contains(wanted), "{reason}");
        let shown = file.origin().to_string();
        assert!(
            shown.starts_with("new pipeline cache: the file cannot be used: "),
            "{shown}"
        );
        check(&gpu, &make(&gpu, Stage::Compute, &file).expect("a pass"));
        file.save().expect("to save");
        assert_eq!(*open(&gpu, &folder.0).origin(), CacheOrigin::File);
    }
}

#[test]
fn a_file_that_cannot_be_read_or_written_is_an_origin_and_an_error() {
    let folder = Folder::new("unreadable");
    let gpu = gpu();
    let name = open(&gpu, &folder.0).path().expect("a file").to_owned();
    std::fs::create_dir(&name).expect("a folder in its place");
    let file = open(&gpu, &folder.0);
    assert!(
        matches!(file.origin(), CacheOrigin::Replaced { .. }),
        "{:?}",
        file.origin()
    );
    check(&gpu, &make(&gpu, Stage::Compute, &file).expect("a pass"));
    let error = file.save().expect_err("a refusal").to_string();
    assert!(
        error.starts_with(&format!("cannot write `{}`", name.display())),
        "{error}"
    );
    assert_eq!(folder.names().len(), 1, "no unfinished file stays");
}

#[test]
fn a_device_without_caches_makes_passes_as_before() {
    let folder = Folder::new("without");
    let gpu = Gpu::new();
    let file = open(&gpu, &folder.0);
    let wanted = "no pipeline cache: the device was created without the feature PIPELINE_CACHE";
    assert_eq!(file.origin().to_string(), wanted);
    assert!(file.cache().is_none() && file.path().is_none());
    check(&gpu, &make(&gpu, Stage::Compute, &file).expect("a pass"));
    file.save().expect("nothing to save");
    assert!(folder.names().is_empty());
}

/// A cache of another device is refused by wgpu, so that each of these is known to hand it on.
#[test]
fn every_pipeline_is_made_with_the_cache() {
    let folder = Folder::new("other");
    let with_caches = self::gpu();
    let (gpu, file) = (with_caches.sibling(), open(&with_caches, &folder.0));
    let options = PassOptions::default().pipeline_cache(file.cache());
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Fragment);
    let copy = Shader::from_json(&manifest, &wgsl).expect("a shader");
    let covering = "@vertex fn cover() -> @builtin(position) vec4f { return vec4f(); }";
    let drawn = DrawOptions::new(covering, "cover").pass(options.clone());
    let emitted = [DOWN.emit(Stage::Compute), BLEND.emit(Stage::Compute)];
    let shaders = emitted
        .each_ref()
        .map(|of| Shader::from_json(&of.manifest, &of.wgsl).expect("a shader"));
    let named = [("down", &shaders[0]), ("blend", &shaders[1])];
    let errors = [
        make(&gpu, Stage::Compute, &file).err(),
        make(&gpu, Stage::Fragment, &file).err(),
        Draw::from_shader(&gpu.device, &copy, &drawn).err(),
        Chain::from_shaders(&gpu.device, &glow(), &named, &options).err(),
        Passes::new(&gpu.device, options).get(&copy).err(),
    ];
    for error in errors {
        let error = error.expect("a refusal").to_string();
        assert!(
            error.contains("could not be made") && error.contains("PipelineCache"),
            "{error}"
        );
    }
}
