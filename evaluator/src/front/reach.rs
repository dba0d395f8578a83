//! Items that a kernel reaches. Errors elsewhere do not concern it.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A word of an item's text that may name another item.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Mention {
    /// `name`: a function, a constant, a type.
    Plain(String),
    /// `Type::name`: either.
    Qualified(String),
    /// `.name(..)`: a method of some type.
    Method(String),
    /// An item by its whole name, which no text mentions.
    Whole(String),
}

/// The words that the text of items mentions, by the items' names.
#[derive(Debug, Default)]
pub struct Mentions {
    words: BTreeMap<String, BTreeSet<Mention>>,
}

impl Mentions {
    /// Adds the text of an item. What is added twice counts together.
    pub fn add(&mut self, item: &str, text: TokenStream) {
        collect_mentions(text, self.words.entry(item.to_owned()).or_default());
    }

    /// Lets an item need another, though its text does not mention it.
    pub fn add_need(&mut self, item: &str, other: &str) {
        let needed = Mention::Whole(other.to_owned());
        self.words.entry(item.to_owned()).or_default().insert(needed);
    }

    /// Names of the items that `entry` reaches by any mention. Coarse, never too small.
    pub fn reached_items<'n>(&self, names: impl Iterator<Item = &'n String>, entry: &str) -> BTreeSet<String> {
        let items = ByWord::new(names);
        let mut reached = BTreeSet::new();
        let mut pending = vec![entry.to_owned()];
        while let Some(name) = pending.pop() {
            if !reached.insert(name.clone()) {
                continue;
            }
            for mention in self.words.get(&name).into_iter().flatten() {
                pending.extend(items.resolve_mention(mention));
            }
        }
        reached
    }

    /// Returns whether the text of `item` mentions one of `others`. Conservative: may return true for an item that is not mentioned.
    pub fn mentions_any(&self, item: &str, others: &[&String]) -> bool {
        let others = ByWord::new(others.iter().copied());
        let mut mentions = self.words.get(item).into_iter().flatten();
        mentions.any(|mention| match mention {
            Mention::Whole(name) => others.contains_name(name),
            other => others.resolve_mention(other).next().is_some(),
        })
    }
}

/// Items by the last word of their names.
struct ByWord<'n> {
    plain: HashMap<&'n str, Vec<&'n String>>,
    members: HashMap<&'n str, Vec<&'n String>>,
}

impl<'n> ByWord<'n> {
    fn new(names: impl Iterator<Item = &'n String>) -> Self {
        let (mut plain, mut members) = (HashMap::<_, Vec<_>>::new(), HashMap::<_, Vec<_>>::new());
        for name in names {
            match name.rsplit_once("::") {
                Some((_, last)) => members.entry(last).or_default().push(name),
                None => plain.entry(name.as_str()).or_default().push(name),
            }
        }
        ByWord { plain, members }
    }

    fn contains_name(&self, name: &str) -> bool {
        let all = self.plain.values().chain(self.members.values()).flatten();
        all.into_iter().any(|known| *known == name)
    }

    /// Names of the items that a mention may stand for.
    fn resolve_mention(&self, mention: &Mention) -> impl Iterator<Item = String> {
        let (plain, member, whole) = match mention {
            Mention::Plain(word) => (Some(word), None, None),
            Mention::Whole(name) => (None, None, Some(name.clone())),
            Mention::Method(word) => (None, Some(word), None),
            Mention::Qualified(word) => (Some(word), Some(word), None),
        };
        let plain = plain
            .and_then(|word| self.plain.get(word.as_str()))
            .into_iter()
            .flatten();
        let member = member
            .and_then(|word| self.members.get(word.as_str()))
            .into_iter()
            .flatten();
        plain.chain(member).map(|name| (*name).clone()).chain(whole)
    }
}

fn collect_mentions(text: TokenStream, out: &mut BTreeSet<Mention>) {
    let tokens: Vec<TokenTree> = text.into_iter().collect();
    let punct = |at: usize| match tokens.get(at) {
        Some(TokenTree::Punct(p)) => p.as_char(),
        _ => ' ',
    };
    let before = |k: usize, n: usize| k.checked_sub(n).map_or(' ', punct);
    for (k, token) in tokens.iter().enumerate() {
        let word = match token {
            TokenTree::Group(group) => {
                collect_mentions(group.stream(), out);
                continue;
            }
            TokenTree::Ident(word) => word.to_string(),
            TokenTree::Punct(_) | TokenTree::Literal(_) => continue,
        };
        let path = punct(k + 1) == ':' && punct(k + 2) == ':';
        let called = path || matches!(tokens.get(k + 1), Some(TokenTree::Group(_)));
        match (before(k, 2), before(k, 1)) {
            // `a..b`, or a method, or a field.
            (two, '.') if two != '.' => {
                if called {
                    out.insert(Mention::Method(word));
                }
            }
            // A lifetime; a module before `::`, which functions are found without.
            (_, '\'') => {}
            _ if path && punct(k + 3) != '<' && word.starts_with(char::is_lowercase) => {}
            (':', ':') => drop(out.insert(Mention::Qualified(word))),
            // `name: type`, or `field: value`.
            _ if punct(k + 1) == ':' && !path => {}
            _ => drop(out.insert(Mention::Plain(word))),
        }
    }
}
