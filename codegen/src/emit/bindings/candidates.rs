//! The items that a shader's module has for its candidates, other shaders that compute the same.

use super::pass::{Given, Targets};
use super::{Module, doc_line, rust_identifier};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

/// Input of the module of a shader with candidates.
pub struct CandidatesModule<'a> {
    /// Shaders that differ with the names of their candidates. The first one, of the kernel's own settings, has the module.
    pub shaders: Vec<(&'a str, Module<'a>)>,
    /// Candidates with the text of another one, whose name follows.
    pub twins: &'a [(String, String)],
}

/// Returns the modules of the other shaders, the constant `CANDIDATES` and `Pass::choose`.
pub fn quote_candidates(
    set: &CandidatesModule<'_>,
    others: &[TokenStream],
    given: &Given,
    targets: &Targets,
) -> TokenStream {
    let candidates = set.shaders.iter().enumerate().map(|(k, (name, module))| {
        let module = rust_identifier(module.name);
        let module = (k > 0).then(|| quote! { #module:: });
        quote! { straightline_runtime::Candidate { name: #name, shader: &#module SHADER } }
    });
    let count = Literal::usize_unsuffixed(set.shaders.len());
    let twins = set.twins.iter();
    let twins = twins.map(|(name, twin)| doc_line(&format!("`{name}` has the same text as `{twin}`.")));
    let choose = given.quote_choose(targets);
    quote! {
        #(#others)*

        /// Candidates of the shader, which compute the same.
        #(#[doc = #twins])*
        pub static CANDIDATES: [straightline_runtime::Candidate<'static>; #count] = [#(#candidates),*];

        #choose
    }
}
