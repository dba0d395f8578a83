//! Built-in kernels, each parsed once per process.

use std::collections::BTreeMap;
use std::sync::LazyLock;
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;
use straightline_kernels::{CATALOGUE, OptionText, OptionValue};

/// Returns the built-in kernel `name`, parsed on the first call, because many forms of one kernel read its options.
///
/// # Errors
///
/// An unknown name.
pub fn load_builtin(name: &str) -> Result<Kernel, Errors> {
    static KERNELS: LazyLock<BTreeMap<&'static str, Kernel>> = LazyLock::new(|| {
        let names = CATALOGUE.iter().map(|entry| entry.name);
        names
            .filter_map(|name| Some((name, Kernel::builtin(name).ok()?)))
            .collect()
    });
    match KERNELS.get(name) {
        Some(kernel) => {
            kernel.options()?;
            Ok(kernel.clone())
        }
        None => Kernel::builtin(name),
    }
}

/// An option and its value.
pub type Setting = (String, OptionValue);

/// Parses the options of `settings`, in their order.
///
/// # Errors
///
/// As [`Kernel::option_values`].
pub fn parse_settings(kernel: &Kernel, settings: &[OptionText]) -> Result<Vec<Setting>, Errors> {
    let values = kernel.option_values(settings)?;
    let named = settings
        .iter()
        .filter_map(|(name, _)| values.get(name).map(|value| (name.clone(), value.clone())));
    Ok(named.collect())
}

/// Spells settings as text, for the generator and for records.
pub fn spell_settings(settings: &[Setting]) -> Vec<OptionText> {
    let spelled = settings.iter().map(|(name, value)| (name.clone(), value.to_string()));
    spelled.collect()
}
