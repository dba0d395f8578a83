//! A shader between its tree and its texts: the tree is cloned, legalised, named and printed once per language.

use super::print::PrintedText;
use super::refusal::Refusal;
use super::resources::Resources;
use super::statements::{basic_blocks, count_text};
use super::{ast, comments, host_reads, legalise, lower, names, print, tidy, translate};
use crate::compiled::Compiled;
use crate::spec::{DebugInfo, Target};
use std::collections::BTreeSet;
use straightline_manifest::{Counts, Form, Precision};

/// Returns the tree of a kernel's statements, with its outputs at the end.
pub fn kernel_tree(compiled: &Compiled, precision: Precision) -> ast::Module<'_> {
    let half = precision == Precision::F16;
    let mut module = lower::lower_kernel(compiled, half);
    if half {
        legalise::legalise_half(&mut module);
    }
    tidy::tidy_kernel(&mut module, &compiled.graph, compiled.policy.reads);
    module
}

/// Returns the tree of a shader with comments, before a language's own rules, and its counts. A kernel in half
/// precision is counted in full precision.
pub fn shader_tree<'g>(compiled: &'g Compiled, resources: &Resources) -> (ast::Module<'g>, Counts) {
    let mut module = kernel_tree(compiled, resources.options.precision);
    let mut counts = compiled.counts.clone();
    match resources.options.precision {
        Precision::F32 => count_text(&module, &compiled.graph, &mut counts),
        Precision::F16 => count_text(&kernel_tree(compiled, Precision::F32), &compiled.graph, &mut counts),
    }
    let body = std::mem::take(&mut module.body);
    module.body = comments::comment_groups(body, &compiled.graph);
    lower::wrap_entry_point(&mut module, resources);
    counts.basic_blocks = basic_blocks(&module.body);
    (module, counts)
}

/// A shader before printing.
pub struct Shader<'s, 'g> {
    pub compiled: &'g Compiled,
    pub resources: &'s Resources,
    pub tree: &'s ast::Module<'g>,
    pub wgsl: Wgsl<'g>,
}

/// The WGSL of a shader without its header.
pub struct Wgsl<'g> {
    /// Bindings under their names in WGSL.
    resources: Resources,
    text: print::Printed<'g>,
}

impl<'g> Wgsl<'g> {
    pub fn new(tree: &ast::Module<'g>, resources: &Resources, marks: bool) -> Result<Wgsl<'g>, Refusal> {
        let resources = resources.spelled_for(Target::Wgsl)?;
        let mut tree = tree.clone();
        legalise::legalise_wgsl(&mut tree, marks);
        finish_tree(&mut tree, &resources, Target::Wgsl)?;
        let text = print::Printed::new(&print::Wgsl { resources: &resources }, &tree);
        Ok(Wgsl { resources, text })
    }

    /// Returns the whole text.
    fn with_header(&self, header: &[String]) -> PrintedText<'g> {
        let resources = &self.resources;
        self.text.with_header(&print::Wgsl { resources }, header)
    }
}

impl<'g> Shader<'_, 'g> {
    /// Returns the whole shader, parsed and validated by naga; a function with an entry point that only calls it. With
    /// `marks`, every exact value is marked ([`legalise::legalise_wgsl`]), and overrides are variables with their
    /// defaults.
    pub fn validated_module(&self, counts: &Counts, marks: bool) -> Result<translate::Module<'g>, Refusal> {
        let kernel = &self.compiled.kernel;
        if !self.resources.options.is_function() && !marks {
            return translate::Module::parse_wgsl(kernel, self.own_wgsl(counts));
        }
        let whole = self.resources.options.clone().form(Form::Entry);
        let mut whole = Resources::from_compiled(self.compiled, &whole)?;
        whole.holds_defaults = marks;
        // Entry points return whole texels, and functions the kernel's values.
        let (tree, _) = shader_tree(self.compiled, &whole);
        let wgsl = Wgsl::new(&tree, &whole, marks)?.with_header(&print::header_lines(self.compiled, counts, &whole));
        translate::Module::parse_wgsl(kernel, wgsl)
    }

    fn own_wgsl(&self, counts: &Counts) -> PrintedText<'g> {
        self.wgsl
            .with_header(&print::header_lines(self.compiled, counts, self.resources))
    }

    pub fn print_wgsl(&self, counts: &Counts) -> Result<PrintedText<'g>, Refusal> {
        let options = &self.resources.options;
        let wgsl = self.own_wgsl(counts);
        if options.is_function() {
            let enabled = if self.resources.half { "enable f16;\n" } else { "" };
            let stubs = host_reads::host_stubs(&self.wgsl.resources);
            translate::validate_wgsl(&self.compiled.kernel, &format!("{enabled}{}{stubs}", wgsl.text))?;
        }
        if options.enable_subgroups && self.resources.subgroups {
            let mut enabled = PrintedText::default();
            enabled.push_text(&format!("enable subgroups;\n{}", directive_gap(self.resources.half)));
            enabled.append(&wgsl);
            return Ok(enabled);
        }
        Ok(wgsl)
    }

    /// Returns the GLSL of a target, and whether naga has validated it.
    pub fn print_glsl(&self, target: Target, counts: &Counts) -> Result<(PrintedText<'g>, bool), Refusal> {
        let resources = &self.resources.spelled_for(target)?;
        let mut tree = self.tree.clone();
        // Hosts compile functions together with their own text, in a version of their choice.
        let precise = matches!(target, Target::Glsl450 | Target::Glsl430) && !resources.options.is_function();
        legalise::legalise_glsl(&mut tree, resources, target == Target::Glsl450, precise);
        finish_tree(&mut tree, resources, target)?;
        let mut header = print::header_lines(self.compiled, counts, self.resources);
        if resources.options.debug == DebugInfo::Lines {
            let places = self.compiled.graph.places.iter().flatten();
            let used: BTreeSet<u32> = places.map(|place| place.span.file).collect();
            let named = used.iter().filter_map(|k| Some((k, resources.files.get(*k as usize)?)));
            header.extend(named.map(|(k, path)| format!("Lines of string {k} are those of {path}.")));
        }
        let printer = print::Glsl::new(resources, target);
        let glsl = print::print_module(&printer, &tree, &header);
        // naga parses no other version of GLSL.
        let is_read = target == Target::Glsl450 && printer.unread_constructs(&tree).is_empty();
        if is_read {
            translate::validate_glsl(&self.compiled.kernel, resources.options.stage, &glsl.text)?;
        }
        Ok((glsl, is_read))
    }

    pub fn print_hlsl(&self, counts: &Counts) -> Result<PrintedText<'g>, Refusal> {
        let mut tree = self.tree.clone();
        legalise::legalise_hlsl(&mut tree, self.resources);
        let resources = self.resources.spelled_for(Target::Hlsl)?;
        finish_tree(&mut tree, &resources, Target::Hlsl)?;
        let header = print::header_lines(self.compiled, counts, self.resources);
        Ok(print::print_module(
            &print::Hlsl::new(&resources, &tree),
            &tree,
            &header,
        ))
    }
}

/// Names the variables of a tree, and strips its comments on request: the last step before printing.
fn finish_tree(tree: &mut ast::Module<'_>, resources: &Resources, target: Target) -> Result<(), Refusal> {
    if resources.options.strip_comments {
        comments::strip_comments(&mut tree.body);
        for function in &mut tree.functions {
            function.comment.clear();
            comments::strip_comments(&mut function.body);
        }
    }
    names::assign_names(tree, resources, target)
}

/// Text between a directive and the directive or header that follows it.
fn directive_gap(half: bool) -> &'static str {
    if half { "" } else { "\n" }
}
