//! A shader between its tree and its texts: the tree is cloned, legalised, named and printed once a language.

use super::refusal::Refusal;
use super::resources::Resources;
use super::statements::{basic_blocks, count_text};
use super::{ast, comments, host_reads, legalise, lower, names, print, tidy, translate};
use crate::compiled::Compiled;
use crate::spec::Target;
use straightline_manifest::{Counts, Form, Precision};

/// The tree of a kernel's statements, with its outputs at the end.
pub fn kernel(compiled: &Compiled, precision: Precision) -> ast::Module<'_> {
    let half = precision == Precision::F16;
    let mut module = lower::lower(compiled, half);
    if half {
        legalise::half(&mut module);
    }
    tidy::tidy(&mut module, &compiled.graph, compiled.policy.reads);
    module
}

/// The tree of a shader, with comments, before a language's own rules, and what is counted in it: of a kernel in half precision, what
/// is counted in full.
pub fn tree<'g>(compiled: &'g Compiled, resources: &Resources) -> (ast::Module<'g>, Counts) {
    let mut module = kernel(compiled, resources.options.precision);
    let mut counts = compiled.counts.clone();
    match resources.options.precision {
        Precision::F32 => count_text(&module, &compiled.graph, &mut counts),
        Precision::F16 => count_text(&kernel(compiled, Precision::F32), &compiled.graph, &mut counts),
    }
    let body = std::mem::take(&mut module.body);
    module.body = comments::comment_groups(body, &compiled.graph);
    lower::entry(&mut module, resources);
    counts.basic_blocks = basic_blocks(&module.body);
    (module, counts)
}

/// A shader before it is written.
pub struct Shader<'s, 'g> {
    pub compiled: &'s Compiled,
    pub resources: &'s Resources,
    pub tree: &'s ast::Module<'g>,
    pub wgsl: Wgsl,
}

/// The WGSL of a shader without its header.
pub struct Wgsl {
    /// Bindings under their names in WGSL.
    resources: Resources,
    text: print::Printed,
}

impl Wgsl {
    pub fn new(tree: &ast::Module<'_>, resources: &Resources, marks: bool) -> Result<Wgsl, Refusal> {
        let resources = resources.spelled(Target::Wgsl)?;
        let mut tree = tree.clone();
        legalise::wgsl(&mut tree, marks);
        finish(&mut tree, &resources, Target::Wgsl)?;
        let text = print::Printed::new(&print::Wgsl { resources: &resources }, &tree);
        Ok(Wgsl { resources, text })
    }

    /// The whole text.
    fn under(&self, header: &[String]) -> String {
        let resources = &self.resources;
        self.text.under(&print::Wgsl { resources }, header)
    }
}

impl Shader<'_, '_> {
    /// The whole shader as naga has read and validated it; of a function, with the entry point that calls nothing else. With `marks`
    /// every exact value is marked ([`legalise::wgsl`]).
    pub fn validated(&self, counts: &Counts, marks: bool) -> Result<translate::Module, Refusal> {
        let kernel = &self.compiled.kernel;
        if !self.resources.options.is_function() && !marks {
            return translate::Module::parse_wgsl(kernel, &self.own_wgsl(counts));
        }
        let whole = self.resources.options.clone().form(Form::Entry);
        let whole = Resources::of(self.compiled, &whole)?;
        // Entry points give whole texels, and functions what the kernel gives.
        let (tree, _) = tree(self.compiled, &whole);
        let wgsl = Wgsl::new(&tree, &whole, marks)?.under(&print::header(self.compiled, counts, &whole));
        translate::Module::parse_wgsl(kernel, &wgsl)
    }

    fn own_wgsl(&self, counts: &Counts) -> String {
        self.wgsl.under(&print::header(self.compiled, counts, self.resources))
    }

    pub fn wgsl(&self, counts: &Counts) -> Result<String, Refusal> {
        let options = &self.resources.options;
        let wgsl = self.own_wgsl(counts);
        if options.is_function() {
            let enabled = match options.precision {
                Precision::F32 => wgsl.clone(),
                Precision::F16 => format!("enable f16;\n{wgsl}"),
            };
            let read = enabled + &host_reads::stubs(&self.wgsl.resources);
            translate::Module::parse_wgsl(&self.compiled.kernel, &read)?;
        }
        Ok(match options.enable_subgroups && self.resources.subgroups {
            true => format!("enable subgroups;\n{}{wgsl}", gap(options.precision)),
            false => wgsl,
        })
    }

    /// The GLSL of a target, and whether naga has validated it.
    pub fn glsl(&self, target: Target, counts: &Counts) -> Result<(String, bool), Refusal> {
        let resources = &self.resources.spelled(target)?;
        let mut tree = self.tree.clone();
        // Hosts compile functions with what stands around them, in a version of theirs.
        let precise = matches!(target, Target::Glsl450 | Target::Glsl430) && !resources.options.is_function();
        legalise::glsl(&mut tree, resources, target == Target::Glsl450, precise);
        finish(&mut tree, resources, target)?;
        let header = print::header(self.compiled, counts, self.resources);
        let printer = print::Glsl::new(resources, target);
        let glsl = print::module(&printer, &tree, &header);
        // naga reads no other GLSL.
        let is_read = target == Target::Glsl450 && printer.unread(&tree).is_empty();
        if is_read {
            translate::validate_glsl(&self.compiled.kernel, resources.options.stage, &glsl)?;
        }
        Ok((glsl, is_read))
    }

    pub fn hlsl(&self, counts: &Counts) -> Result<String, Refusal> {
        let mut tree = self.tree.clone();
        legalise::hlsl(&mut tree, self.resources);
        let resources = self.resources.spelled(Target::Hlsl)?;
        finish(&mut tree, &resources, Target::Hlsl)?;
        let header = print::header(self.compiled, counts, self.resources);
        Ok(print::module(&print::Hlsl::new(&resources, &tree), &tree, &header))
    }
}

/// Names the variables of a tree, and strips its comments where that is asked for: the last step before printing.
fn finish(tree: &mut ast::Module<'_>, resources: &Resources, target: Target) -> Result<(), Refusal> {
    if resources.options.strip_comments {
        comments::strip(&mut tree.body);
        for function in &mut tree.functions {
            function.comment.clear();
            comments::strip(&mut function.body);
        }
    }
    names::assign(tree, resources, target)
}

/// Text between a directive and the directive or header that follows it.
fn gap(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "\n",
        Precision::F16 => "",
    }
}
