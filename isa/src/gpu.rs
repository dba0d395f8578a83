//! GPU that a shader is compiled for.

use super::vendors::{Model, VENDORS, Vendor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A GPU that a shader is compiled for: one that need not be present, or that of this machine.
///
/// Its text is `VENDOR:GPU` such as `amd:navi21`; `navi21` alone is read too, since GPUs of two vendors have different names.
/// [`Gpu::DEVICE`] is `device`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Gpu {
    /// Indices in the table of vendors.
    vendor: usize,
    model: usize,
}

impl Gpu {
    /// The GPU of this machine by its own driver, if the driver reports on what it compiles: NVIDIA's does.
    pub const DEVICE: Gpu = Gpu {
        vendor: VENDORS.len(),
        model: 0,
    };

    /// Returns every GPU that Mesa compiles for without it, by vendor, oldest first.
    pub fn all() -> impl Iterator<Item = Gpu> {
        let each = VENDORS.iter().enumerate();
        each.flat_map(|(vendor, row)| (0..row.models.len()).map(move |model| Gpu { vendor, model }))
    }

    /// Returns the GPUs that a text names: one by `amd:navi21` or `navi21`, all of a vendor by `amd`.
    ///
    /// # Errors
    ///
    /// There is none of that name; the error lists those that exist.
    pub fn parse_several(text: &str) -> Result<Vec<Gpu>, String> {
        let of_vendor: Vec<Gpu> = Gpu::all().filter(|gpu| gpu.vendor_name() == text).collect();
        match of_vendor.is_empty() {
            false => Ok(of_vendor),
            true => Ok(vec![text.parse()?]),
        }
    }

    pub(crate) fn rows(self) -> Option<(&'static Vendor, &'static Model)> {
        let vendor = VENDORS.get(self.vendor)?;
        Some((vendor, vendor.models.get(self.model)?))
    }

    /// Name of the vendor: `amd`; `device` for the GPU of this machine.
    pub fn vendor_name(self) -> &'static str {
        self.rows().map_or("device", |(vendor, _)| vendor.name)
    }

    /// Name of the vendor in sentences: `AMD`.
    pub fn vendor_title(self) -> &'static str {
        self.rows().map_or("this machine", |(vendor, _)| vendor.title)
    }

    /// Number by which graphics interfaces know the vendor, such as 0x1002; `None` for the GPU of this machine.
    pub fn vendor_id(self) -> Option<u32> {
        self.rows().map(|(vendor, _)| vendor.id)
    }

    /// Name without the vendor: `navi21`.
    pub fn model_name(self) -> &'static str {
        self.rows().map_or("device", |(_, model)| model.name)
    }

    /// Architecture, year and products.
    pub fn about(self) -> &'static str {
        self.rows()
            .map_or("the GPU of this machine, by its own driver", |(_, model)| model.about)
    }

    /// Unit of [`Figures::cost`](crate::Figures::cost): only AMD's compiler has cycles of a wave among many.
    pub fn cost_unit(self) -> &'static str {
        match self.vendor_name() {
            "amd" => "cycles",
            _ => "instructions",
        }
    }

    /// Unit of [`Figures::occupancy`](crate::Figures::occupancy).
    pub fn occupancy_unit(self) -> &'static str {
        self.rows().map_or("waves", |(vendor, _)| vendor.at_once)
    }
}

impl fmt::Display for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.rows() {
            None => f.write_str("device"),
            Some((vendor, model)) => write!(f, "{}:{}", vendor.name, model.name),
        }
    }
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Gpu({self})")
    }
}

impl From<Gpu> for String {
    fn from(gpu: Gpu) -> String {
        gpu.to_string()
    }
}

impl TryFrom<String> for Gpu {
    type Error = String;

    fn try_from(text: String) -> Result<Gpu, String> {
        text.parse()
    }
}

impl FromStr for Gpu {
    type Err = String;

    fn from_str(text: &str) -> Result<Gpu, String> {
        let mut all = Gpu::all().chain([Gpu::DEVICE]);
        if let Some(gpu) = all.find(|gpu| gpu.to_string() == text || gpu.model_name() == text) {
            return Ok(gpu);
        }
        let given = text.split(':').next().unwrap_or_default();
        let of_vendor: Vec<_> = Gpu::all().filter(|gpu| gpu.vendor_name() == given).collect();
        let list = |gpus: &[Gpu]| gpus.iter().map(Gpu::to_string).collect::<Vec<_>>().join(", ");
        Err(match of_vendor.as_slice() {
            [] => {
                let each = VENDORS
                    .iter()
                    .filter_map(|vendor| Some((vendor.name, vendor.models.last()?.name)));
                let each: Vec<_> = each.map(|(vendor, model)| format!("{vendor}:{model}")).collect();
                format!(
                    "no such GPU; there are {}, ..., and `device`; `straightline isa` lists all",
                    each.join(", ")
                )
            }
            known if known.iter().any(|gpu| gpu.vendor_name() == text) => format!("name one GPU: {}", list(known)),
            known => format!("no such GPU of that vendor; there are {}", list(known)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_read_as_they_are_written() {
        for gpu in Gpu::all().chain([Gpu::DEVICE]) {
            assert_eq!(gpu.to_string().parse(), Ok(gpu));
            assert_eq!(
                gpu.model_name().parse(),
                Ok(gpu),
                "records of earlier versions have no vendor"
            );
        }
        let names: BTreeSet<_> = Gpu::all().map(Gpu::model_name).collect();
        assert_eq!(names.len(), Gpu::all().count(), "a name is of one vendor");
        assert!(VENDORS.iter().all(|vendor| !names.contains(vendor.name)));
    }

    #[test]
    fn several_are_named_by_their_vendor() {
        let names = |text| Gpu::parse_several(text).map(|all| all.len());
        assert_eq!(names("nvidia"), Ok(7));
        assert_eq!(names("apple"), Ok(1));
        assert_eq!(names("adreno730"), Ok(1));
        assert!(names("amd:navi99").is_err_and(|why| why.contains("amd:navi21") && !why.contains("nvidia")));
        assert!(names("matrox").is_err_and(|why| why.contains("apple:m1")));
    }
}
