//! Candidates of a shader: other settings with which it computes the same.

use super::ShaderSpec;
use std::fmt;
use std::sync::Arc;

/// Candidates of a shader beside the one that its own settings describe, which is called `default`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Candidates(Vec<CandidateSpec>);

/// A candidate: a name, and the change to the settings.
#[derive(Clone)]
pub(crate) struct CandidateSpec {
    pub name: String,
    change: Arc<dyn Fn(ShaderSpec) -> ShaderSpec + Send + Sync>,
}

impl fmt::Debug for CandidateSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("CandidateSpec").field(&self.name).finish_non_exhaustive()
    }
}

impl CandidateSpec {
    /// The candidate's description of a shader whose own is `spec`.
    pub fn apply(&self, spec: &ShaderSpec) -> ShaderSpec {
        (self.change)(spec.clone())
    }
}

impl Candidates {
    /// Name of the candidate that the shader's own settings describe.
    pub const DEFAULT: &'static str = "default";

    pub fn push(&mut self, name: &str, change: impl Fn(ShaderSpec) -> ShaderSpec + Send + Sync + 'static) {
        self.0.push(CandidateSpec {
            name: name.to_owned(),
            change: Arc::new(change),
        });
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &CandidateSpec> {
        self.0.iter()
    }

    /// Refuses names that are no names, or given twice.
    pub fn check(&self) -> Result<(), String> {
        for (k, CandidateSpec { name, .. }) in self.0.iter().enumerate() {
            if syn::parse_str::<syn::Ident>(name).is_err() {
                return Err(format!(
                    "`{name}` cannot name a candidate: use a name of Rust, such as `looped`"
                ));
            }
            if name == Self::DEFAULT || self.0[..k].iter().any(|candidate| candidate.name == *name) {
                return Err(format!(
                    "two candidates are called `{name}`; the shader's own settings are `default`"
                ));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Candidates;

    #[test]
    fn names_that_are_none_are_refused() {
        let refused = |names: &[&str]| {
            let mut candidates = Candidates::default();
            names.iter().for_each(|name| candidates.push(name, |spec| spec));
            candidates.check().err()
        };
        assert_eq!(refused(&["looped", "shared"]), None);
        assert!(refused(&["a candidate"]).is_some_and(|why| why.contains("`a candidate` cannot name a candidate")));
        assert!(refused(&["looped", "looped"]).is_some_and(|why| why.contains("two candidates are called `looped`")));
        assert!(refused(&["default"]).is_some_and(|why| why.contains("own settings are `default`")));
    }
}
