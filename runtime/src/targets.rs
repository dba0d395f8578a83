//! Targets that a pass writes.

use crate::error::{Error, Names};
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
    /// The targets for the `outputs` of `kernel`, in that order: each exactly once, and nothing else.
    pub(crate) fn arrange_targets(self, kernel: &str, outputs: &[&str]) -> Result<Vec<&'t TextureView>, Error> {
        let known = || outputs.iter().copied().collect::<Names>();
        let views = match self.0 {
            Given::One(view) if outputs.len() == 1 => return Ok(vec![view]),
            Given::One(_) => {
                return Err(Error::TargetNames {
                    kernel: kernel.to_owned(),
                    known: known(),
                });
            }
            Given::Named(views) => views,
        };
        for (i, (name, _)) in views.iter().enumerate() {
            if !outputs.contains(name) {
                return Err(Error::UnknownTarget {
                    kernel: kernel.to_owned(),
                    name: (*name).to_owned(),
                    known: known(),
                });
            }
            if views[..i].iter().any(|(earlier, _)| earlier == name) {
                return Err(Error::DuplicateTarget {
                    kernel: kernel.to_owned(),
                    name: (*name).to_owned(),
                });
            }
        }
        let view = |name: &str| views.iter().find(|(known, _)| *known == name).map(|(_, view)| *view);
        let ordered = outputs.iter().map(|output| {
            view(output).ok_or_else(|| Error::MissingTarget {
                kernel: kernel.to_owned(),
                name: (*output).to_owned(),
                known: known(),
            })
        });
        ordered.collect()
    }
}
