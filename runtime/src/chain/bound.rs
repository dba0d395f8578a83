//! A chain with all that it reads and writes, ready to be recorded.

use super::pictures::Memory;
use super::recipe::Recipe;
use crate::{Bound, Error, Timer, UniformValue};
use std::sync::Arc;
use wgpu::{CommandEncoder, ComputePass, Queue, TextureView};

/// A [`Chain`](crate::Chain) with its inputs, targets, uniforms and the textures between its passes: made by
/// [`Chain::bind`](crate::Chain::bind), and recorded any number of times.
///
/// As a [`Bound`], it keeps its resources alive, has no lifetime, can be shared between threads, and outlives the
/// chain.
#[derive(Debug)]
pub struct BoundChain {
    pub(super) recipe: Arc<Recipe>,
    /// In the order of the plan.
    pub(super) passes: Vec<Bound>,
    /// Of the plan's pictures, in their order.
    pub(super) views: Vec<TextureView>,
    pub(super) memory: Memory,
}

impl BoundChain {
    /// The chain's name.
    pub fn name(&self) -> &str {
        &self.recipe.plan.chain
    }

    /// Names of the passes in the order in which they run.
    pub fn passes(&self) -> impl ExactSizeIterator<Item = &str> {
        self.recipe.plan.passes.iter().map(|pass| &*pass.name)
    }

    /// Records all passes into `encoder`, which is of the same device. It cannot fail and checks nothing; of its own it
    /// allocates nothing.
    pub fn encode(&self, encoder: &mut CommandEncoder) {
        self.encode_first(self.passes.len(), encoder);
    }

    /// Records the first passes, in a debug group with the chain's name.
    fn encode_first(&self, count: usize, encoder: &mut CommandEncoder) {
        encoder.push_debug_group(self.name());
        for pass in &self.passes[..count] {
            pass.encode(encoder);
        }
        encoder.pop_debug_group();
    }

    /// Records all passes into a compute pass of the caller's, one dispatch after another, in a debug group with the
    /// chain's name: see [`Bound::encode_into`].
    ///
    /// # Errors
    ///
    /// [`Error::Chain`] with [`Error::PassKind`] for the first pass with a fragment shader. Nothing has been recorded
    /// then.
    pub fn encode_into(&self, pass: &mut ComputePass<'_>) -> Result<(), Error> {
        let mut pairs = self.passes.iter().zip(self.recipe.plan.passes.iter());
        if let Some((bound, plan)) = pairs.find(|(bound, _)| !bound.is_compute()) {
            return Err(self.recipe.name_pass(plan, &bound.plan, bound.wrong_pass()));
        }
        pass.push_debug_group(self.name());
        let recorded = self.passes.iter().try_for_each(|bound| bound.encode_into(pass));
        pass.pop_debug_group();
        recorded
    }

    /// [`encode`](Self::encode), timed on the GPU: each pass is a span of `timer`, in the order of
    /// [`passes`](Self::passes).
    ///
    /// # Errors
    ///
    /// [`Error::TimerFull`] if there is no room for all of them. Nothing has been recorded then.
    pub fn encode_timed(&self, encoder: &mut CommandEncoder, timer: &mut Timer) -> Result<(), Error> {
        timer.check_room(self.passes.len())?;
        encoder.push_debug_group(self.name());
        let timed = self
            .passes
            .iter()
            .try_for_each(|pass| pass.encode_timed(encoder, timer));
        encoder.pop_debug_group();
        timed
    }

    /// Records the passes up to the one that writes `picture`, and returns its view: after a submission it holds the
    /// picture, and nothing else that shares its texture. `None` if the chain has no such picture; nothing has been
    /// recorded then.
    pub fn encode_until(&self, encoder: &mut CommandEncoder, picture: &str) -> Option<&TextureView> {
        let writes = |pass: &straightline_manifest::chain::PassPlan| pass.writes.iter().any(|name| name == picture);
        let last = self.recipe.plan.passes.iter().position(writes)?;
        self.encode_first(last + 1, encoder);
        self.picture(picture)
    }

    /// Sets the uniform `name` of every pass that has it, for the next submission to `queue`: see
    /// [`Bound::write_uniform`]. Numbers, vectors and matrices cause no allocation here.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownUniform`] if no pass has it, or [`Error::UniformType`] for a value of another type. Nothing has
    /// been written then.
    pub fn write_uniform(&self, queue: &Queue, name: &str, value: impl Into<UniformValue>) -> Result<(), Error> {
        let value = value.into();
        let uniform = self.recipe.find_uniform(name, value.ty())?;
        for pass in uniform.passes.iter().map(|number| &self.passes[*number]) {
            pass.uniforms.write_value(&pass.plan, queue, name, &value)?;
        }
        Ok(())
    }

    /// The view of a picture, or of a target by the name of its result. The chain's own textures can be sampled and
    /// copied from.
    ///
    /// Pictures that share a texture have views of the same one: after a frame it holds the last of them.
    /// [`encode_until`](Self::encode_until) stops at an earlier one.
    pub fn picture(&self, name: &str) -> Option<&TextureView> {
        self.pictures()
            .find_map(|(picture, view)| (picture == name).then_some(view))
    }

    /// All pictures by name, results included, in the order in which they are written. A view's texture has the size.
    pub fn pictures(&self) -> impl ExactSizeIterator<Item = (&str, &TextureView)> {
        let names = self.recipe.plan.pictures.iter().map(|picture| &*picture.name);
        names.zip(&self.views)
    }

    /// Bytes of the textures that the chain owns, as their formats have them: without a driver's padding.
    pub fn bytes(&self) -> u64 {
        let bytes = self.memory.values().map(|texture| {
            let texel = texture.format().block_copy_size(None).unwrap_or(0);
            u64::from(texture.width()) * u64::from(texture.height()) * u64::from(texel)
        });
        bytes.sum()
    }

    /// The textures alone.
    pub(super) fn into_memory(self) -> Memory {
        self.memory
    }
}
