//! Chains that travel: plan, manifests and texts are read when the program runs.

use super::Chain;
use super::recipe::plan_error;
use crate::{Error, PassOptions, Shader};
use straightline_manifest::chain::ChainPlan;
use wgpu::Device;

impl Chain {
    /// The chain that `chain_json` describes. `files` returns the manifest and the WGSL of a shader by its name, and is
    /// called once for each.
    ///
    /// ```no_run
    /// # use straightline_runtime::{Chain, Error, PassOptions, wgpu};
    /// fn load(device: &wgpu::Device, folder: &std::path::Path) -> Result<Chain, Box<dyn std::error::Error>> {
    ///     let read = |name: &str, kind: &str| std::fs::read_to_string(folder.join(format!("{name}.{kind}"))).ok();
    ///     let chain = std::fs::read_to_string(folder.join("bloom.chain.json"))?;
    ///     let files = |shader: &str| Some((read(shader, "json")?, read(shader, "wgsl")?));
    ///     Ok(Chain::from_json(device, &chain, files, &PassOptions::default())?)
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Manifest`] if `chain_json` is not a chain or of another schema; [`Error::Chain`] for a shader without
    /// files; those of [`Shader::from_json`] and of [`from_shaders`](Self::from_shaders).
    pub fn from_json<M: AsRef<str>, W: AsRef<str>>(
        device: &Device,
        chain_json: &str,
        mut files: impl FnMut(&str) -> Option<(M, W)>,
        options: &PassOptions,
    ) -> Result<Self, Error> {
        let plan = ChainPlan::from_json(chain_json)?;
        plan.check().map_err(|bad| plan_error(&plan, bad.place, bad.problem))?;
        let names = plan.shaders();
        let texts = names.iter().map(|name| {
            let missing = || plan_error(&plan, format!("shader `{name}`"), "its files are not given".to_owned());
            files(name).ok_or_else(missing)
        });
        let texts = texts.collect::<Result<Vec<_>, _>>()?;
        let shaders = texts
            .iter()
            .map(|(manifest, wgsl)| Shader::from_json(manifest.as_ref(), wgsl.as_ref()));
        let shaders = shaders.collect::<Result<Vec<_>, _>>()?;
        let named: Vec<(&str, &Shader<'_>)> = names.iter().copied().zip(&shaders).collect();
        Self::from_shaders(device, &plan, &named, options)
    }
}
