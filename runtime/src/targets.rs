//! Targets that a pass writes.

use crate::error::{Error, Names};
use crate::plan::Plan;
use wgpu::TextureView;

/// The textures that a pass writes, all of one size: a view where the kernel gives one value, or views by the names of the
/// fields that it gives, in any order.
///
/// Made of `&view`, or of `&[("albedo", &albedo), ("depth", &depth)]`.
#[derive(Clone, Debug)]
pub struct Targets<'t>(Given<'t>);

#[derive(Clone, Debug)]
enum Given<'t> {
    One(&'t TextureView),
    Named(Vec<(&'t str, &'t TextureView)>),
}

impl<'t> From<&'t TextureView> for Targets<'t> {
    fn from(view: &'t TextureView) -> Self {
        Targets(Given::One(view))
    }
}

impl<'t> From<&[(&'t str, &'t TextureView)]> for Targets<'t> {
    fn from(views: &[(&'t str, &'t TextureView)]) -> Self {
        Targets(Given::Named(views.to_vec()))
    }
}

impl<'t, const N: usize> From<&[(&'t str, &'t TextureView); N]> for Targets<'t> {
    fn from(views: &[(&'t str, &'t TextureView); N]) -> Self {
        views.as_slice().into()
    }
}

impl<'t> Targets<'t> {
    /// The targets in the order of the plan's outputs: each exactly once, and nothing else.
    pub(crate) fn arrange_targets(self, plan: &Plan) -> Result<Vec<&'t TextureView>, Error> {
        let kernel = || plan.kernel.to_string();
        let known = || {
            plan.outputs
                .iter()
                .map(|output| output.name.as_ref())
                .collect::<Names>()
        };
        let views = match self.0 {
            Given::One(view) if plan.outputs.len() == 1 => return Ok(vec![view]),
            Given::One(_) => {
                return Err(Error::TargetNames {
                    kernel: kernel(),
                    known: known(),
                });
            }
            Given::Named(views) => views,
        };
        for (i, (name, _)) in views.iter().enumerate() {
            if plan.outputs.iter().all(|output| output.name != *name) {
                return Err(Error::UnknownTarget {
                    kernel: kernel(),
                    name: (*name).to_owned(),
                    known: known(),
                });
            }
            if views[..i].iter().any(|(earlier, _)| earlier == name) {
                return Err(Error::DuplicateTarget {
                    kernel: kernel(),
                    name: (*name).to_owned(),
                });
            }
        }
        let view = |name: &str| views.iter().find(|(known, _)| *known == name).map(|(_, view)| *view);
        let ordered = plan.outputs.iter().map(|output| {
            view(&output.name).ok_or_else(|| Error::MissingTarget {
                kernel: kernel(),
                name: output.name.to_string(),
                known: known(),
            })
        });
        ordered.collect()
    }
}
