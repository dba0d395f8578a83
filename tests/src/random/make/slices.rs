//! Methods of arrays and slices.

use super::Maker;
use super::types::Ty;

impl Maker {
    /// An array that a method of slices changes or reads.
    pub(super) fn slice_statement(&mut self) {
        let of = match self.random.below(3) {
            0 => Ty::I32,
            1 => Ty::U32,
            _ => self.plain_type(),
        };
        let ty = Ty::array(of.clone(), 4);
        let (value, own, text) = (self.some(&ty, 1), self.fresh("list"), self.ty(&of));
        let written = self.ty(&ty);
        self.line(format!("let mut {own}: {written} = {value};"));
        let whole = matches!(of, Ty::I32 | Ty::U32);
        let index = self.without_effects(|m| m.index(4, false, 1));
        let element = self.some(&of, 1);
        let reads = self.random.once_in(2);
        if !reads {
            let line = match self.random.below(16) {
                0 => format!("{own}.swap({index}, {});", self.random.below(4)),
                1 => format!("{own}.swap({}, {});", self.random.below(4), self.random.below(4)),
                2 => format!("{own}[1..].reverse();"),
                3 => format!("{own}.reverse();"),
                4 => format!("{own}[..3].fill({element});"),
                5 => format!("{own}.rotate_left({});", self.random.below(4)),
                6 => format!("{own}.rotate_right({});", self.random.below(4)),
                7 if whole => format!("{own}.{}();", self.random.pick(&["sort", "sort_unstable"])),
                7 if of == Ty::F32 => format!("{own}.sort_by(|l, r| r.total_cmp(l));"),
                8 if whole => format!("{own}[1..].sort_by_key(|e| *e & 7);"),
                9 => {
                    let other = self.some(&Ty::array(of.clone(), 3), 1);
                    format!("{own}[1..3].copy_from_slice(&same::<[{text}; 3]>({other})[1..]);")
                }
                10 => format!("{own}.fill_with(|| same::<{text}>({element}));"),
                11 => {
                    let name = self.random.pick(&["chunks_mut", "chunks_exact_mut"]);
                    format!(
                        "for e in {own}.{name}({}) {{ e[0] = {element}; }}",
                        self.random.between(1, 3)
                    )
                }
                12 => format!(
                    "{{ let (l, r) = {own}.split_at_mut({}); std::mem::swap(&mut l[0], &mut r[0]); }}",
                    self.random.between(1, 3)
                ),
                13 => {
                    let name = self.random.pick(&["split_first_mut", "split_last_mut"]);
                    format!("if let Some((l, r)) = {own}.{name}() {{ *l = {element}; r[1] = *l; }}")
                }
                14 => {
                    let name = self.random.pick(&["first_mut", "last_mut"]);
                    format!("if let Some(e) = {own}[1..].{name}() {{ *e = {element}; }}")
                }
                15 => format!("if let Some(e) = {own}.get_mut(({index}) + 2) {{ *e = {element}; }}"),
                _ => format!("{own}[..3].iter_mut().rev().for_each(|e| *e = *e + *e);"),
            };
            self.line(line);
            self.bind(&own, &ty, true);
            return;
        }
        let read = match self.random.below(9) {
            0 => format!("{own}.first().copied().unwrap_or({element})"),
            1 => format!("{own}[..2].last().copied().unwrap_or({element})"),
            2 => format!("{own}.get(({index}) + 2).copied().unwrap_or({element})"),
            3 => format!("if {own}.contains(&{element}) {{ {own}[0] }} else {{ {own}[3] }}"),
            4 => format!(
                "{{ let (l, r) = {own}.split_at({}); r[0] - l[0] }}",
                self.random.between(1, 3)
            ),
            5 => format!("{own}.split_first().map_or({element}, |(l, r)| *l - r[1])"),
            6 => format!("{own}.split_last().map_or({element}, |(l, r)| *l - r[1])"),
            7 => {
                let name = self.random.pick(&["starts_with", "ends_with"]);
                format!("if {own}.{name}(&[{element}]) {{ {own}[1] }} else {{ {own}[2] }}")
            }
            _ if whole => format!("if {own}[1..].is_sorted() {{ {own}[1] }} else {{ {own}[2] }}"),
            _ => format!("if {own}.is_empty() {{ {own}[1] }} else {{ {own}[2] }}"),
        };
        self.bind(&own, &ty, true);
        self.keep(&of, &read);
    }
}
