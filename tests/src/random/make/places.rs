//! Variables and parts of them, to be read or written.

use super::types::Ty;
use super::{Feature, Hold, Local, Maker, Want};

/// A variable or a part of it.
#[derive(Clone, Debug)]
pub struct Place {
    /// Text in Rust.
    pub text: String,
    pub ty: Ty,
    /// The variable.
    pub root: String,
    /// Set if the place is the whole of a variable that is a reference.
    pub reference: Hold,
    /// Indices in the text: the place of each bracket, and the number of elements.
    pub indices: Vec<(usize, usize)>,
}

impl Maker {
    /// A variable's value and all parts of it that need no runtime index.
    fn parts_of(&self, local: &Local) -> Vec<Place> {
        let mut found = Vec::new();
        let whole = match local.hold {
            Hold::Value => local.name.clone(),
            _ => format!("*{}", local.name),
        };
        found.push(Place {
            text: whole,
            ty: local.ty.clone(),
            root: local.name.clone(),
            reference: local.hold,
            indices: Vec::new(),
        });
        self.inner(&local.name, &local.ty, &local.name, &[], &mut found);
        found
    }

    fn inner(&self, text: &str, ty: &Ty, root: &str, indices: &[(usize, usize)], found: &mut Vec<Place>) {
        let mut indices = indices.to_vec();
        let mut parts: Vec<(String, Ty)> = Vec::new();
        match ty {
            Ty::Struct(k) => {
                let fields = &self.structures[*k].fields;
                parts.extend(fields.iter().map(|(name, ty)| (format!("{text}.{name}"), ty.clone())));
            }
            Ty::Tuple(all) => {
                parts.extend(
                    all.iter()
                        .enumerate()
                        .map(|(k, ty)| (format!("{text}.{k}"), ty.clone())),
                );
            }
            Ty::Array(of, len) => {
                parts.extend((0..*len).map(|k| (format!("{text}[{k}]"), (**of).clone())));
                indices.push((text.len(), *len));
            }
            Ty::Vec(_, n) => {
                let lane = ty.lane().expect("a vector has lanes");
                parts.extend((0..*n as usize).map(|k| (format!("{text}.{}", &"xyzw"[k..=k]), lane.clone())));
            }
            _ => {}
        }
        for (text, ty) in parts {
            found.push(Place {
                text: text.clone(),
                ty: ty.clone(),
                root: root.to_owned(),
                reference: Hold::Value,
                indices: indices.clone(),
            });
            self.inner(&text, &ty, root, &indices, found);
        }
    }

    /// Something in reach that can be read as a type.
    pub(super) fn read(&mut self, ty: &Ty, known: bool) -> Option<String> {
        let mut found = Vec::new();
        for local in self.visible() {
            if known && !local.known {
                continue;
            }
            found.extend(self.parts_of(&local).into_iter().filter(|p| p.ty == *ty));
        }
        found.retain(|p| self.copies(&p.ty));
        if found.is_empty() {
            return None;
        }
        let mut place = self.random.pick(&found);
        if !known && self.inputs && self.chance(Feature::Aggregates, 3) {
            self.index_at_run_time(&mut place, |m, len| match m.random.below(3) {
                0 => format!("p.rem_euclid({len}) as usize"),
                1 => format!("(q % {len}) as usize"),
                _ => format!("(pixel.x.clamp(0, {})) as usize", len - 1),
            });
        }
        Some(if place.text.starts_with('*') {
            format!("({})", place.text)
        } else {
            place.text
        })
    }

    /// An element of an array in reach, by an index that is computed.
    pub(super) fn indexed(&mut self, ty: &Ty, want: Want) -> Option<String> {
        let mut arrays = Vec::new();
        for local in self.visible() {
            if want.known && !local.known {
                continue;
            }
            arrays.extend(self.parts_of(&local).into_iter().filter(|p| match &p.ty {
                Ty::Array(of, len) => **of == *ty && *len > 0,
                _ => false,
            }));
        }
        arrays.retain(|p| self.copies(&p.ty));
        if arrays.is_empty() {
            return None;
        }
        let array = self.random.pick(&arrays);
        let Ty::Array(of, len) = &array.ty else { return None };
        let (slice, len) = self.slice(*len, 5);
        let known = want.known || !of.plain() && !self.on(Feature::Aggregates);
        let index = self.index(len, known, want.depth.min(2));
        let text = if array.text.starts_with('*') {
            format!("({})", array.text)
        } else {
            array.text
        };
        Some(format!("{text}{slice}[{index}]"))
    }

    /// Brackets that take a slice of an array of `len` elements, once in `n` times, and the number of its elements.
    pub(super) fn slice(&mut self, len: usize, n: usize) -> (String, usize) {
        if len == 0 || !self.chance(Feature::Slices, n) {
            return (String::new(), len);
        }
        let from = self.random.below(len);
        let to = from + 1 + self.random.below(len - from);
        match self.random.below(4) {
            0 => (format!("[{from}..]"), len - from),
            1 => (format!("[..{to}]"), to),
            2 => (format!("[{from}..={}]", to - 1), to - from),
            _ => (format!("[{from}..{to}]"), to - from),
        }
    }

    /// A `usize` below `len`.
    pub(super) fn index(&mut self, len: usize, known: bool, depth: u32) -> String {
        let fits = |l: &Local| l.ty == Ty::Usize && l.range.is_some_and(|(low, high)| low >= 0 && high < len as i64);
        let counters: Vec<Local> = self.visible().into_iter().filter(fits).collect();
        if !counters.is_empty() && self.random.below(3) > 0 {
            let local = self.random.pick(&counters);
            return match local.hold {
                Hold::Value => local.name,
                _ => format!("*{}", local.name),
            };
        }
        if known || self.random.once_in(3) {
            return self.random.below(len).to_string();
        }
        let want = Want {
            depth,
            known: false,
            inferred: false,
        };
        match self.random.below(4) {
            0 => format!("({}.rem_euclid({len})) as usize", self.receiver(&Ty::I32, want)),
            1 => format!("({}.clamp(0, {})) as usize", self.receiver(&Ty::I32, want), len - 1),
            2 => {
                let e = self.expr(&Ty::Usize, want);
                format!("({e}).min({})", len - 1)
            }
            _ => format!("({} % {len}) as usize", self.expr(&Ty::U32, want)),
        }
    }

    /// Replaces the last index of a place, and at times those before it.
    fn index_at_run_time(&mut self, place: &mut Place, index: impl Fn(&mut Maker, usize) -> String) {
        for (n, (at, len)) in place.indices.clone().into_iter().rev().enumerate() {
            if n > 0 && (!self.on(Feature::Aggregates) || self.random.once_in(2)) {
                continue;
            }
            let Some(end) = place.text[at..].find(']') else { return };
            let (slice, len) = self.slice(len, 4);
            let index = index(self, len);
            place.text.replace_range(at..=at + end, &format!("{slice}[{index}]"));
        }
    }

    /// Places that may be written, of one type if one is given.
    pub(super) fn writable(&mut self, ty: Option<&Ty>) -> Option<Place> {
        let mut found = Vec::new();
        for local in self.visible() {
            let writes = local.hold == Hold::Mutable || (local.mutable && local.hold == Hold::Value);
            if !writes || local.counter || local.known {
                continue;
            }
            found.extend(
                self.parts_of(&local)
                    .into_iter()
                    .filter(|p| ty.is_none_or(|ty| p.ty == *ty)),
            );
        }
        if found.is_empty() {
            return None;
        }
        let mut place = self.random.pick(&found);
        // Sometimes an index is computed.
        let last = place.indices.last().map_or(0, |(at, _)| *at);
        let plain = place.ty.plain() && place.text.rfind('[') == Some(last) && place.text.ends_with(']');
        if self.random.once_in(2) && (plain || self.on(Feature::Aggregates)) {
            let root = place.root.clone();
            self.freeze(&root, true);
            self.index_at_run_time(&mut place, |m, len| m.index(len, false, 1));
            self.freeze(&root, false);
        }
        Some(place)
    }

    /// A mutable reference to a place of a type, for an argument; the variable that it borrows.
    pub(super) fn borrow(&mut self, ty: &Ty) -> Option<(String, String)> {
        if !self.on(Feature::Mutable) {
            return None;
        }
        let place = self.writable(Some(ty))?;
        let text = match place.reference {
            Hold::Mutable if self.random.once_in(2) => place.root.clone(),
            _ => format!("&mut {}", place.text),
        };
        Some((text, place.root))
    }
}
