//! Vendors whose compilers Mesa has, and how each is told which GPU to compile for.
//!
//! A new vendor is a row of [`VENDORS`]; a new GPU is a row of its `models`.

/// A vendor of GPUs, and Mesa's driver for them.
#[derive(Debug)]
pub(crate) struct Vendor {
    /// First part of a GPU's name: `amd`.
    pub name: &'static str,
    /// Name in sentences.
    pub title: &'static str,
    /// Number by which graphics interfaces know the vendor: that of PCI, mostly.
    pub id: u32,
    /// First word of the file that names the driver for Vulkan's loader.
    pub manifest: &'static str,
    /// Library that stands in for the kernel's part of the driver.
    pub shim: &'static str,
    /// Environment variable that tells the shim which GPU there is; empty if the shim knows one only.
    pub variable: &'static str,
    /// Environment variable that tells the driver itself, without a shim, until Mesa 25.
    pub forced: Option<&'static str>,
    /// Environment variables that the driver needs besides.
    pub further: &'static [(&'static str, &'static str)],
    /// Unit of `Figures::occupancy`.
    pub at_once: &'static str,
    /// Packages to install.
    pub install: &'static str,
    /// GPUs, oldest first.
    pub models: &'static [Model],
}

/// A GPU.
#[derive(Debug)]
pub(crate) struct Model {
    /// Second part of its name: `navi21`.
    pub name: &'static str,
    /// Value of the vendor's environment variable.
    pub value: &'static str,
    /// Part of the name that the driver must have for its device.
    pub says: &'static str,
    /// Architecture, year and products.
    pub about: &'static str,
}

const fn model(name: &'static str, value: &'static str, says: &'static str, about: &'static str) -> Model {
    Model {
        name,
        value,
        says,
        about,
    }
}

const SHIMS: &str = "mesa-vulkan-drivers, mesa-drm-shim and libvulkan1 of Debian 13's backports or later";
const BUILT: &str = "a Mesa that was built with `-Dtools=drm-shim` (no Debian package has it for Intel)";
const ARM64: &str = "mesa-vulkan-drivers, mesa-drm-shim and libvulkan1 of Debian 13's backports or later, for arm64";

/// Every vendor, in the order of tables.
pub(crate) static VENDORS: [Vendor; 8] = [
    Vendor {
        name: "amd",
        title: "AMD",
        id: 0x1002,
        manifest: "radeon",
        shim: "libamdgpu_noop_drm_shim.so",
        variable: "AMDGPU_GPU_ID",
        forced: Some("RADV_FORCE_FAMILY"),
        further: &[],
        at_once: "waves of a SIMD unit",
        install: "libvulkan1 and mesa-vulkan-drivers; with Mesa 26 or later, mesa-drm-shim too",
        models: &[
            model("polaris10", "polaris10", "POLARIS10", "GCN 4, 2016: Radeon RX 470, 480"),
            model("vega10", "vega10", "VEGA10", "GCN 5, 2017: Radeon RX Vega"),
            model("navi10", "navi10", "NAVI10", "RDNA 1, 2019: Radeon RX 5700"),
            model(
                "navi21",
                "navi21",
                "NAVI21",
                "RDNA 2, 2020: Radeon RX 6800, 6900; PlayStation 5, Xbox Series and Steam Deck have its kind",
            ),
            model("navi31", "navi31", "NAVI31", "RDNA 3, 2022: Radeon RX 7900"),
            model("navi33", "navi33", "NAVI33", "RDNA 3, 2023: Radeon RX 7600"),
            model("gfx1201", "gfx1201", "GFX1201", "RDNA 4, 2025: Radeon RX 9070"),
        ],
    },
    Vendor {
        name: "nvidia",
        title: "NVIDIA",
        id: 0x10de,
        manifest: "nouveau",
        shim: "libnouveau_noop_drm_shim.so",
        variable: "NOUVEAU_CHIPSET",
        forced: None,
        further: &[("NVK_I_WANT_A_BROKEN_VULKAN_DRIVER", "1")],
        at_once: "warps of a multiprocessor",
        install: SHIMS,
        models: &[
            model("maxwell", "124", "NVK", "Maxwell, 2014: GeForce GTX 970, 980"),
            model("pascal", "134", "NVK", "Pascal, 2016: GeForce GTX 1080"),
            model("volta", "140", "NVK", "Volta, 2017: Titan V"),
            model("turing", "162", "NVK", "Turing, 2018: GeForce RTX 2080"),
            model("ampere", "172", "NVK", "Ampere, 2020: GeForce RTX 3080"),
            model("ada", "192", "NVK", "Ada Lovelace, 2022: GeForce RTX 4090"),
            model("blackwell", "1b2", "NVK", "Blackwell, 2025: GeForce RTX 5090"),
        ],
    },
    Vendor {
        name: "intel",
        title: "Intel",
        id: 0x8086,
        manifest: "intel",
        shim: "libintel_noop_drm_shim.so",
        variable: "INTEL_STUB_GPU_PLATFORM",
        forced: None,
        further: &[],
        at_once: "lanes of a thread",
        install: BUILT,
        models: &[
            model("skl", "skl", "Intel", "Gen 9, 2015: Skylake"),
            model("icl", "icl", "Intel", "Gen 11, 2019: Ice Lake"),
            model("tgl", "tgl", "Intel", "Xe, 2020: Tiger Lake"),
            model("dg2", "dg2", "Intel", "Xe HPG, 2022: Arc A770"),
            model("mtl", "mtl", "Intel", "Xe LPG, 2023: Meteor Lake"),
            model("lnl", "lnl", "Intel", "Xe2, 2024: Lunar Lake"),
            model("bmg", "bmg", "Intel", "Xe2, 2024: Arc B580"),
        ],
    },
    Vendor {
        name: "qualcomm",
        title: "Qualcomm",
        id: 0x5143,
        manifest: "freedreno",
        shim: "libfreedreno_noop_drm_shim.so",
        variable: "FD_GPU_ID",
        forced: None,
        further: &[],
        at_once: "waves of a core",
        install: SHIMS,
        models: &[
            model("adreno630", "630", "630", "Adreno 6xx, 2018: Snapdragon 845"),
            model("adreno660", "660", "660", "Adreno 6xx, 2021: Snapdragon 888"),
            model("adreno730", "730", "730", "Adreno 7xx, 2022: Snapdragon 8 Gen 1"),
            model(
                "adreno740",
                "740",
                "740",
                "Adreno 7xx, 2023: Snapdragon 8 Gen 2; Quest 3",
            ),
            model("adreno750", "750", "750", "Adreno 7xx, 2024: Snapdragon 8 Gen 3"),
            model("adreno830", "830", "830", "Adreno 8xx, 2025: Snapdragon 8 Elite"),
        ],
    },
    Vendor {
        name: "apple",
        title: "Apple",
        id: 0x106b,
        manifest: "asahi",
        shim: "libasahi_noop_drm_shim.so",
        variable: "",
        forced: None,
        further: &[],
        at_once: "threads of a core",
        install: SHIMS,
        models: &[model("m1", "", "M1", "G13G, 2020: M1")],
    },
    Vendor {
        name: "arm",
        title: "Arm",
        id: 0x13b5,
        manifest: "panfrost",
        shim: "libpanfrost_noop_drm_shim.so",
        variable: "PAN_GPU_ID",
        forced: None,
        further: &[("PAN_I_WANT_A_BROKEN_VULKAN_DRIVER", "1")],
        at_once: "threads, of the most that there can be",
        install: ARM64,
        models: &[
            model("g31", "7093", "G31", "Bifrost, 2018: Mali-G31"),
            model("g52", "7212", "G52", "Bifrost, 2018: Mali-G52"),
            model("g610", "a867", "G610", "Valhall, 2021: Mali-G610, RK3588"),
        ],
    },
    Vendor {
        name: "broadcom",
        title: "Broadcom",
        id: 0x14e4,
        manifest: "broadcom",
        shim: "libv3d_noop_drm_shim.so",
        variable: "V3D_GPU_ID",
        forced: None,
        further: &[],
        at_once: "threads of a core",
        install: ARM64,
        models: &[
            model("pi4", "42", "V3D 4.2", "VideoCore VI, 2019: Raspberry Pi 4"),
            model("pi5", "71", "V3D 7.1", "VideoCore VII, 2023: Raspberry Pi 5"),
        ],
    },
    Vendor {
        name: "imagination",
        title: "Imagination",
        id: 0x1010,
        manifest: "powervr",
        shim: "libpowervr_noop_drm_shim.so",
        variable: "PVR_SHIM_DEVICE_BVNC",
        forced: None,
        further: &[("PVR_I_WANT_A_BROKEN_VULKAN_DRIVER", "1")],
        at_once: "instances",
        install: ARM64,
        models: &[model("axe", "33.15.11.3", "AXE", "A-series, 2019: AXE-1-16M")],
    },
];
