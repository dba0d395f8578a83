//! Passes that become one, whose workgroups compute a picture after another in their memory.

use super::fusion::{Kept, operations, unfit};
use super::planned::Planned;
use super::spec::{ChainSpec, Fuse};
use crate::pipeline::Start;
use straightline_evaluator::diagnostic::{Code, Diagnostic};
use straightline_evaluator::front::chain::{Chain, Source};
use straightline_evaluator::ir::{Texture, Type};
use straightline_evaluator::passes::{self, Cascade, Part};
use straightline_evaluator::policy::{ReadOrder, Share};
use straightline_manifest::chain::SizeRule;
use straightline_manifest::{Origin, Stage};

/// Most work of a cascade, in that of its pictures without overlapping tiles. More is refused, except where pictures are named.
const MOST_OVERLAP: f64 = 2.0;

/// Most work of a cascade's threads, in that of the texels that are stored. Five levels of a picture, each a quarter of the one
/// before, have 3.8: few threads have a texel of the last ones.
const MOST_IDLENESS: f64 = 4.0;

/// Passes that become one, in order: one pass as it is, or several with the tiles of their pictures.
pub struct Group {
    /// Indices of the passes.
    pub members: Vec<usize>,
    /// Tiles of the members' pictures; `None` of a single pass.
    pub cascade: Option<Cascade>,
}

/// Planned passes with their kernels, whose textures are called after what they hold.
pub struct Grouping<'c> {
    pub chain: &'c Chain,
    pub spec: &'c ChainSpec,
    pub planned: &'c [Planned],
    pub starts: &'c [Start],
    /// Textures that sizes name.
    pub sized: &'c [Texture],
}

impl Grouping<'_> {
    /// Groups the passes, and returns the pictures that are left apart with the reasons.
    ///
    /// # Errors
    ///
    /// A picture that is asked for by name and cannot be shared; settings that do not go with it.
    pub fn group(&self) -> Result<(Vec<Group>, Vec<Kept>), Box<Diagnostic>> {
        let mut groups: Vec<Group> = (0..self.planned.len())
            .map(|pass| Group {
                members: vec![pass],
                cascade: None,
            })
            .collect();
        if !self
            .chain
            .pictures
            .iter()
            .any(|picture| self.spec.fuse.shares(&picture.name))
        {
            return Ok((groups, Vec::new()));
        }
        self.check_settings()?;
        let mut kept: Vec<Kept> = Vec::new();
        for reader in 0..self.planned.len() {
            while self.merge_one(&mut groups, reader, &mut kept) {}
        }
        let is_shared = |picture: usize| {
            let mut cascades = groups.iter().filter(|group| group.cascade.is_some());
            cascades.any(|group| {
                let (_, before) = group.members.split_last().expect("groups have members");
                before.iter().any(|member| self.planned[*member].picture == picture)
            })
        };
        kept.retain(|kept| !is_shared(kept.picture) && self.spec.fuse.shares(&self.chain.pictures[kept.picture].name));
        kept.sort_by_key(|kept| kept.picture);
        kept.dedup_by_key(|kept| kept.picture);
        if let (Fuse::Named { shared, .. }, pictures) = (&self.spec.fuse, &self.chain.pictures) {
            let unshared = (0..pictures.len()).find(|k| shared.contains(&pictures[*k].name) && !is_shared(*k));
            if let Some(picture) = unshared {
                let found = kept.iter().find(|kept| kept.picture == picture);
                let reason = found.map_or("no later pass reads it", |kept| kept.reason.as_str());
                return Err(unfit(&pictures[picture], reason));
            }
        }
        Ok((groups, kept))
    }

    /// Refuses settings with which no workgroup computes several pictures.
    fn check_settings(&self) -> Result<(), Box<Diagnostic>> {
        let (emit, settings) = (&self.spec.shader.emit, &self.spec.shader.settings);
        let of_threads = |size: [u32; 2]| size == passes::Cascade::THREADS;
        let unfit = [
            (
                emit.stage != Stage::Compute,
                "stage",
                "a fragment shader has no workgroups",
            ),
            (emit.is_function(), "form", "a function has no workgroups"),
            (emit.region, "region", "tiles of a region may begin anywhere"),
            (
                emit.origin != Origin::default(),
                "origin",
                "rows of tiles count from above",
            ),
            (
                !emit.workgroup.is_none_or(of_threads),
                "workgroup",
                "their workgroups have 16x16 threads",
            ),
            (
                settings.share != Share::Invocation,
                "share",
                "their texels are shared already",
            ),
            (
                settings.block != [1, 1],
                "block",
                "each thread computes one texel at a time",
            ),
            (
                settings.reads == ReadOrder::Gather,
                "reads",
                "they are read from workgroup memory",
            ),
        ];
        let Some((_, knob, reason)) = unfit.into_iter().find(|(is_unfit, ..)| *is_unfit) else {
            return Ok(());
        };
        let what = format!("pictures cannot be shared by workgroups with this `{knob}`: {reason}");
        let help = format!("leave `{knob}` out, or `share` out of `fuse`");
        Err(Box::new(
            Diagnostic::error_at(Code::UnfitSetting, self.chain.span, what)
                .label("this chain")
                .help(help),
        ))
    }

    /// Merges the group of a pass with one that draws what it reads, if there is one. The group stands at its last pass.
    fn merge_one(&self, groups: &mut Vec<Group>, reader: usize, kept: &mut Vec<Kept>) -> bool {
        let Some(own) = groups.iter().position(|group| group.members.contains(&reader)) else {
            return false;
        };
        let mut others: Vec<usize> = (0..own)
            .filter(|other| self.reads_shared(&groups[own], &groups[*other]))
            .collect();
        others.sort_by_key(|other| std::cmp::Reverse(groups[*other].members.last().copied()));
        for other in others {
            let mut members = [&groups[other].members[..], &groups[own].members[..]].concat();
            members.sort_unstable();
            match self.plan(groups, &members) {
                Ok(cascade) => {
                    groups[own] = Group {
                        members,
                        cascade: Some(cascade),
                    };
                    groups.remove(other);
                    return true;
                }
                Err(reason) => {
                    let pictures = groups[other].members.iter().map(|member| self.planned[*member].picture);
                    let read =
                        pictures.filter(|picture| groups[own].members.iter().any(|pass| self.reads(*pass, *picture)));
                    kept.extend(read.map(|picture| Kept {
                        picture,
                        reason: reason.clone(),
                    }));
                }
            }
        }
        false
    }

    /// Returns whether a group reads a picture of another one that is to be shared.
    fn reads_shared(&self, group: &Group, other: &Group) -> bool {
        let shared = other.members.iter().map(|member| self.planned[*member].picture);
        let mut shared = shared.filter(|picture| self.spec.fuse.shares(&self.chain.pictures[*picture].name));
        shared.any(|picture| group.members.iter().any(|member| self.reads(*member, picture)))
    }

    fn reads(&self, pass: usize, picture: usize) -> bool {
        self.planned[pass]
            .reads
            .iter()
            .any(|(_, source)| *source == Source::Picture(picture))
    }

    /// Returns whether something besides `members` needs the picture of a pass.
    pub fn is_stored(&self, members: &[usize], pass: usize) -> bool {
        let picture = self.planned[pass].picture;
        let mut others = (0..self.planned.len()).filter(|other| !members.contains(other));
        self.chain.results.contains(&picture) || others.any(|other| self.reads(other, picture))
    }

    /// Pictures of passes, as parts of a cascade.
    pub fn parts<'p>(&'p self, members: &[usize]) -> Vec<Part<'p>> {
        let part = |member: &usize| {
            let picture = &self.chain.pictures[self.planned[*member].picture];
            Part {
                name: &picture.name,
                graph: &self.starts[*member].graph,
                size: &picture.size,
                stored: self.is_stored(members, *member),
            }
        };
        members.iter().map(part).collect()
    }

    /// Plans a cascade of passes. The error is the reason why there is none.
    fn plan(&self, groups: &[Group], members: &[usize]) -> Result<Cascade, String> {
        for member in members {
            if let Some(obstacle) = passes::find_obstacle(&self.starts[*member].graph) {
                return Err(obstacle.to_string());
            }
        }
        self.check_order(groups, members)?;
        let parts = self.parts(members);
        if parts.iter().any(|part| !passes::has_textures(part.size, self.sized)) {
            return Err(passes::Unfused::Size.to_string());
        }
        let stored = parts.iter().filter(|part| part.stored).count();
        if stored > self.spec.most_outputs as usize {
            return Err(format!(
                "a pass would write {stored} pictures, and `most_outputs` is {}",
                self.spec.most_outputs
            ));
        }
        self.check_formats(members)?;
        let cost: Vec<usize> = members.iter().map(|member| operations(&self.starts[*member])).collect();
        let rule_of = |name: &str| -> Option<SizeRule> {
            let picture = self.chain.pictures.iter().find(|picture| picture.name == name);
            let is_input = self.chain.inputs.iter().any(|input| input == name);
            picture
                .map(|picture| picture.size.clone())
                .or(is_input.then(|| SizeRule::of_input(name)))
        };
        let cascade = passes::plan_cascade(&parts, &rule_of, &cost)?;
        if self.spec.fuse != Fuse::Share {
            return Ok(cascade);
        }
        match (cascade.overlap(&cost), cascade.idleness(&cost)) {
            (overlap, _) if overlap > MOST_OVERLAP => {
                Err(format!("overlapping tiles make {overlap:.1} times the work"))
            }
            (_, idleness) if idleness > MOST_IDLENESS => Err(format!(
                "small tiles leave threads without work: {idleness:.1} times the threads that are needed"
            )),
            _ => Ok(cascade),
        }
    }

    /// Checks that everything that `members` read is drawn before their last pass, and what they draw read after it.
    fn check_order(&self, groups: &[Group], members: &[usize]) -> Result<(), String> {
        let last = *members.last().expect("groups have members");
        for group in groups
            .iter()
            .filter(|group| group.members.iter().all(|member| !members.contains(member)))
        {
            let stands = *group.members.last().expect("groups have members");
            for (other, member) in group
                .members
                .iter()
                .flat_map(|other| members.iter().map(move |m| (*other, *m)))
            {
                let of = |pass: usize| &self.chain.pictures[self.planned[pass].picture].name;
                if self.reads(other, self.planned[member].picture) && stands < last {
                    return Err(format!("`{}` needs it before `{}` is drawn", of(other), of(last)));
                }
                if self.reads(member, self.planned[other].picture) && stands > last {
                    return Err(format!("`{}` is drawn after `{}`", of(other), of(last)));
                }
            }
        }
        Ok(())
    }

    /// Checks that all stored pictures of a pass that are colours have one format.
    fn check_formats(&self, members: &[usize]) -> Result<(), String> {
        let is_colour = |member: &usize| {
            let ty = self.starts[*member].graph.targets[0].ty;
            ty.component_count() > 2 && ty.scalar_kind() == Type::F32.scalar_kind()
        };
        let stored = members
            .iter()
            .filter(|member| self.is_stored(members, **member) && is_colour(member));
        let mut formats = stored.map(|member| (self.format_of(*member), self.planned[*member].picture));
        let Some((first, picture)) = formats.next() else {
            return Ok(());
        };
        match formats.find(|(format, _)| *format != first) {
            Some((other, unlike)) => {
                let [first_name, other_name] = [picture, unlike].map(|k| &self.chain.pictures[k].name);
                Err(format!(
                    "`{first_name}` is stored in {first} and `{other_name}` in {other}, and a pass has one format of colours"
                ))
            }
            None => Ok(()),
        }
    }

    /// Format of a pass, if its texels are colours.
    pub fn format_of(&self, pass: usize) -> straightline_manifest::Format {
        let index = self.planned[pass].picture;
        let default = match self.chain.results.contains(&index) {
            true => self.spec.shader.emit.format,
            false => self.spec.pictures.unwrap_or_default(),
        };
        self.chain.pictures[index].format.unwrap_or(default)
    }
}
