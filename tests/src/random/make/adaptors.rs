//! Adaptors of iterators over arrays: those that flatten, choose, or take several values at once.

use super::types::{Lane, Ty};
use super::{Maker, Want};

impl Maker {
    /// A number or vector of an array behind adaptors.
    pub(super) fn adapted(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let repeats = self.repeats;
        self.repeats *= 4;
        let (x, y) = (self.fresh("x"), self.fresh("y"));
        let text = self.ty(ty);
        let array = Ty::array(ty.clone(), 4);
        let source = self.expr(&array, d.inferred(true));
        let all = format!("same::<[{text}; 4]>({source})");
        let mark = self.locals.len();
        self.bind(&x, ty, false);
        let body = self.without_effects(|m| m.expr(ty, d.inferred(true)));
        let condition = self.without_effects(|m| m.condition(d));
        self.locals.truncate(mark);
        let first = self.leaf(ty, d.inferred(true));
        self.repeats = repeats;
        let map = format!("map(|{x}: {text}| -> {text} {{ {body} }})");
        let end = match self.random.below(3) {
            0 => format!("fold(same::<{text}>({first}), |{x}: {text}, {y}: {text}| {x} - {y})"),
            1 => format!("map(|{y}: {text}| {y} + {y}).sum::<{text}>()"),
            _ => format!("sum::<{text}>()"),
        };
        let own = matches!(ty, Ty::I32 | Ty::U32);
        let found = match self.random.below(26) {
            0 => format!("{all}.into_iter().flat_map(|{x}: {text}| [{x}, {body}]).{end}"),
            1 => format!(
                "(0..3usize).flat_map(|{y}| (0..{y}).map(move |{x}| {x} + {y})).map(|{y}| {all}[{y} & 3]).{end}"
            ),
            2 => format!("[{all}, same::<[{text}; 4]>([{first}; 4])].into_iter().flatten().{map}.{end}"),
            3 => format!(
                "{all}.windows(2).map(|{x}: &[{text}]| if {x}.len() == 2 {{ {x}[1] - {x}[0] }} else {{ unreachable!() }}).{end}"
            ),
            4 => {
                let n = self.random.between(2, 3);
                format!("{all}.chunks({n}).map(|{x}: &[{text}]| {x}[0] - {x}[{x}.len() - 1]).{end}")
            }
            5 => {
                let n = self.random.between(2, 3);
                format!("{all}.chunks_exact({n}).map(|{x}: &[{text}]| {x}.iter().copied().sum::<{text}>()).{end}")
            }
            6 => format!("{all}.into_iter().filter(|&{x}: &{text}| {condition}).{map}.{end}"),
            7 => format!(
                "{all}.into_iter().filter_map(|{x}: {text}| -> Option<{text}> {{ ({condition}).then_some({body}) }}).{end}"
            ),
            8 => format!("{all}.into_iter().take_while(|&{x}: &{text}| {condition}).{end}"),
            9 => format!("{all}.into_iter().skip_while(|&{x}: &{text}| {condition}).{map}.{end}"),
            10 => format!(
                "{all}.into_iter().map_while(|{x}: {text}| -> Option<{text}> {{ ({condition}).then_some({body}) }}).{end}"
            ),
            11 => format!("{all}.into_iter().find(|&{x}: &{text}| {condition}).unwrap_or({first})"),
            12 => format!(
                "{all}.into_iter().find_map(|{x}: {text}| -> Option<{text}> {{ ({condition}).then_some({body}) }}).unwrap_or({first})"
            ),
            13 => {
                let name = self.random.pick(&["position", "rposition"]);
                format!("{all}.into_iter().{name}(|{x}: {text}| {condition}).map_or({first}, |{x}| {all}[{x}])")
            }
            14 => format!("{all}.into_iter().reduce(|{x}: {text}, {y}: {text}| {x} - {y}).unwrap_or({first})"),
            15 => format!(
                "{all}.into_iter().{map}.nth({}).unwrap_or({first})",
                self.random.below(5)
            ),
            16 => {
                let name = self.random.pick(&["last", "next"]);
                format!("{all}.iter().cloned().filter(|&{x}: &{text}| {condition}).{name}().unwrap_or({first})")
            }
            17 => format!(
                "{all}.iter().zip(same::<[{text}; 4]>([{first}; 4]).iter().skip(1)).map(|({x}, {y})| *{x} - *{y}).{end}"
            ),
            20 => format!("std::iter::once(same::<{text}>({first})).chain({all}).{end}"),
            21 => format!(
                "std::iter::repeat_n(same::<{text}>({first}), {}).{end}",
                self.random.between(1, 3)
            ),
            22 => format!(
                "std::iter::successors(Some(same::<{text}>({first})), |{x}: &{text}| Some(*{x} + *{x})).take({}).{end}",
                self.random.between(1, 4)
            ),
            23 => format!(
                "{all}.into_iter().zip(std::iter::repeat(same::<{text}>({first}))).map(|({x}, {y})| {x} - {y}).{end}"
            ),
            24 => format!(
                "{all}.into_iter().cycle().take(6).scan(same::<{text}>({first}), |{y}: &mut {text}, {x}: {text}| Some(std::mem::replace({y}, {x}))).{end}"
            ),
            25 => format!("std::iter::empty().chain({all}).{end}"),
            18 if own => {
                let name = self.random.pick(&["min_by_key", "max_by_key"]);
                format!("{all}.into_iter().{name}(|{x}: &{text}| *{x} & 7).unwrap_or({first})")
            }
            18 if *ty == Ty::F32 => {
                let name = self.random.pick(&["min_by", "max_by"]);
                format!("{all}.into_iter().{name}(|{x}: &f32, {y}: &f32| {x}.total_cmp({y})).unwrap_or({first})")
            }
            18 if matches!(ty, Ty::Vec(Lane::I | Lane::U, _)) => {
                format!("{all}.into_iter().max_by_key(|{x}: &{text}| {x}.x & 3).unwrap_or({first})")
            }
            _ if own => format!(
                "{all}.into_iter().{}().unwrap_or({first})",
                self.random.pick(&["min", "max"])
            ),
            _ => format!(
                "if {all}.into_iter().filter(|&{x}: &{text}| {condition}).count() > 1 \
                 {{ same::<{text}>({first}) }} else {{ same::<{text}>({}) }}",
                self.leaf(ty, d.inferred(true))
            ),
        };
        format!("({found})")
    }
}
