//! `--uniform` of studies, whose values go to every kernel that has the uniform.

use crate::commands::run::values;
use crate::failure::Failure;
use straightline_codegen::ir::Uniform;
use straightline_codegen::shorten;

/// Requested values of uniforms.
pub struct Asked<'a> {
    values: &'a [(String, String)],
    found: Vec<bool>,
}

impl<'a> Asked<'a> {
    pub fn new(values: &'a [(String, String)]) -> Asked<'a> {
        Asked {
            values,
            found: vec![false; values.len()],
        }
    }

    /// Returns the values of those of `uniforms` that were requested.
    pub fn values_of(&mut self, uniforms: &[Uniform]) -> Result<Vec<(String, Vec<f64>)>, Failure> {
        let mut values = Vec::new();
        for ((name, text), found) in self.values.iter().zip(&mut self.found) {
            if let Some(uniform) = uniforms.iter().find(|uniform| uniform.name == *name) {
                values.push((name.clone(), values::parse_uniform(name, uniform.ty, text)?));
                *found = true;
            }
        }
        Ok(values)
    }

    /// Fails if a uniform was found nowhere. `owners` says where it was searched.
    pub fn check_all_found(&self, owners: &str) -> Result<(), Failure> {
        match self.found.iter().position(|found| !found) {
            Some(k) => Err(Failure::Usage(format!(
                "no {owners} has a uniform `{}`",
                shorten(&self.values[k].0)
            ))),
            None => Ok(()),
        }
    }
}
