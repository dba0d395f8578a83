//! Compilers that are shell scripts: each says what a driver would, or dies as one does.
#![cfg(all(unix, target_arch = "x86_64"))]

use super::{Compiler, Drivers, Gpu, IsaError};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// Folder of this test, removed at its end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Scratch {
        let path = std::env::temp_dir().join(format!("straightline-isa-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Scratch(path)
    }

    /// A file below the folder.
    fn with(self, path: &str, text: &str) -> Scratch {
        let file = self.0.join(path);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("folders");
        std::fs::write(&file, text).expect("a file");
        std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o755)).expect("permissions");
        self
    }

    /// Drivers of the folder, on a machine that has none.
    fn drivers(&self) -> Drivers {
        let mut drivers = Drivers::in_folder(&self.0);
        drivers.root = self.0.join("nothing");
        drivers
    }

    /// Drivers of a machine whose files are those of the folder.
    fn machine(&self) -> Drivers {
        let mut drivers = Drivers::in_folder(self.0.join("nothing"));
        drivers.root = self.0.clone();
        drivers
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const LISTS: &str = "usr/share/vulkan/icd.d";
const LIBRARIES: &str = "usr/lib/x86_64-linux-gnu";

fn start(drivers: &Drivers, script: &str, gpu: &str) -> Result<Compiler, IsaError> {
    Compiler::start_from(
        drivers,
        Path::new("/bin/sh"),
        &["-c", script],
        gpu.parse().expect("a GPU"),
    )
}

/// The error's text, in which all of `parts` stand.
fn refuses(result: Result<Compiler, IsaError>, parts: &[&str]) {
    let text = result
        .map(|compiler| compiler.device().to_owned())
        .expect_err("an error")
        .to_string();
    for part in parts {
        assert!(text.contains(part), "`{part}` is not in `{text}`");
    }
}

#[test]
fn a_vendor_without_driver_or_shim_says_what_to_install() {
    let scratch = Scratch::new("missing");
    let parts = ["nvidia:ampere", "NVIDIA", "mesa-vulkan-drivers", "STRAIGHTLINE_DRIVERS"];
    refuses(start(&scratch.machine(), "", "nvidia:ampere"), &parts);
    let scratch = scratch.with(&format!("{LISTS}/nouveau_icd.json"), "{}");
    let parts = ["libnouveau_noop_drm_shim.so", "mesa-drm-shim", "STRAIGHTLINE_DRIVERS"];
    refuses(start(&scratch.machine(), "", "nvidia:ampere"), &parts);
    // Drivers of another architecture, and of older GPUs of the vendor, are not asked.
    let scratch = Scratch::new("others")
        .with(&format!("{LISTS}/radeon_icd.aarch64.json"), "{}")
        .with(&format!("{LISTS}/intel_hasvk_icd.json"), "{}");
    refuses(start(&scratch.machine(), "", "amd:navi21"), &["no Vulkan driver"]);
    refuses(start(&scratch.machine(), "", "intel:dg2"), &["no Vulkan driver"]);
}

#[test]
fn a_driver_is_told_which_gpu_it_has() {
    let device = r#"echo "{\"Device\":\"navi21 $RADV_FORCE_FAMILY, $AMDGPU_GPU_ID, $VK_DRIVER_FILES, $LD_PRELOAD\"}""#;
    let scratch = Scratch::new("told").with(&format!("{LISTS}/radeon_icd.x86_64.json"), "{}");
    let found = start(&scratch.machine(), device, "amd:navi21").expect("a compiler");
    let manifest = scratch.0.join(LISTS).join("radeon_icd.x86_64.json");
    assert_eq!(
        found.device(),
        format!("navi21 navi21, , {}, ", manifest.display()),
        "Mesa until 25"
    );
    let scratch = scratch.with(&format!("{LIBRARIES}/libamdgpu_noop_drm_shim.so"), "");
    let found = start(&scratch.machine(), device, "amd:navi21").expect("a compiler");
    let shim = scratch.0.join(LIBRARIES).join("libamdgpu_noop_drm_shim.so");
    let expected = format!("navi21 , navi21, {}, {}", manifest.display(), shim.display());
    assert_eq!(found.device(), expected, "Mesa from 26");
}

#[test]
fn a_folder_of_packages_brings_its_own_loader() {
    let scratch = Scratch::new("loader")
        .with(&format!("{LISTS}/asahi_icd.json"), "{}")
        .with(&format!("{LIBRARIES}/libasahi_noop_drm_shim.so"), "")
        .with(
            &format!("{LIBRARIES}/ld-linux-x86-64.so.2"),
            "#!/bin/sh\necho \"{\\\"Device\\\":\\\"M1 $1 $3 $5 $6\\\"}\"\n",
        );
    let found = start(&scratch.drivers(), "the script", "apple:m1").expect("a compiler");
    assert_eq!(found.device(), "M1 --library-path --preload /bin/sh -c");
    assert_eq!(found.gpu(), "m1".parse().expect("a GPU"));
}

#[test]
fn a_driver_with_another_gpu_is_refused() {
    let scratch = Scratch::new("other").with(&format!("{LISTS}/radeon_icd.json"), "{}");
    let device = r#"echo '{"Device":"AMD Radeon Graphics (RADV NAVI31) (Mesa 26.2.6-1)"}'"#;
    refuses(
        start(&scratch.machine(), device, "amd:navi21"),
        &["amd:navi21", "RADV NAVI31"],
    );
    start(&scratch.machine(), device, "amd:navi31").expect("a compiler");
}

#[test]
fn a_driver_that_dies_leaves_its_last_words() {
    let scratch = Scratch::new("dies").with(&format!("{LISTS}/radeon_icd.json"), "{}");
    let machine = scratch.machine();
    let dies = "echo 'MESA: error: no GPU of that name' >&2; echo '- a list of others' >&2; exit 1";
    refuses(
        start(&machine, dies, "navi21"),
        &["amd:navi21", "the driver ended: MESA: error: no GPU of that name"],
    );
    refuses(start(&machine, "exit 1", "navi21"), &["ended without a word"]);
    refuses(
        start(&machine, "echo '{\"Error\":\"no devices\"}'", "navi21"),
        &["does not compile for amd:navi21: no devices"],
    );
    refuses(start(&machine, "echo nonsense", "navi21"), &["cannot be asked"]);
    let later = r#"echo '{"Device":"NAVI21"}'; read line; echo 'Assertion failed' >&2; exit 134"#;
    let mut compiler = start(&machine, later, "navi21").expect("a compiler");
    let error = compiler.compile(&[0; 20], "main").expect_err("an error").to_string();
    assert_eq!(
        error,
        "the compiler for amd:navi21 cannot be asked: the driver ended: Assertion failed"
    );
    assert!(compiler.compile(&[0; 20], "main").is_err(), "it stays ended");
}

#[test]
fn a_program_that_is_not_there_is_named() {
    let error = Compiler::start(Path::new("/nowhere/straightline"), &[], Gpu::DEVICE).expect_err("an error");
    assert!(matches!(error, IsaError::Process(Gpu::DEVICE, _)), "{error}");
}
