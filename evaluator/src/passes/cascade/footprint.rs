//! Texels of a picture that a kernel reads around its pixel, scaled: `2 * pixel + 1`, `pixel / 2 - 1`.

use crate::ir::{BinaryOp, Graph, Node, NodeId, Op, Scalar, UnaryOp};
use straightline_manifest::chain::SizeRule;

/// Largest numbers that are followed. Frames have fewer pixels, so no sum wraps.
const FARTHEST: i64 = 1 << 24;

/// Texels along an axis that a pixel reads: from `floor(times * pixel / over) + low` to `floor(times * pixel / over) + high`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Factor of the pixel's coordinate, at least 1.
    pub times: i64,
    /// Its divisor, at least 1, without common divisors.
    pub over: i64,
    /// First texel, relative to the scaled pixel.
    pub low: i64,
    /// Last texel, relative to the scaled pixel.
    pub high: i64,
}

/// Sizes of a kernel's textures, by rules.
pub struct Sizes<'a> {
    /// Size of the picture that the kernel draws.
    pub frame: &'a SizeRule,
    /// Size of each texture, by index; `None` if it is not known.
    pub textures: &'a [Option<SizeRule>],
}

/// Component of an integer value, relative to the pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place<'a> {
    /// A number in a range.
    Number([i64; 2]),
    /// The scaled coordinate of the pixel along an axis.
    Near(usize, Span),
    /// `Near` that is clamped to a picture of this size; of unknown size as long as only the start is clamped.
    Inside(usize, Span, Option<&'a SizeRule>),
    /// Width or height of this size, plus a number.
    Side(&'a SizeRule, usize, i64),
}

use Place::{Inside, Near, Number, Side};

/// Reads of a texture by a kernel: across and down. `None` if some place does not follow from the pixel, or if the texture is
/// not read texel by texel.
pub fn find_footprint(graph: &Graph, texture: u32, sizes: &Sizes<'_>) -> Option<[Span; 2]> {
    let places = follow_places(graph, sizes);
    let own = sizes.textures[texture as usize].as_ref();
    let mut found: Option<[Span; 2]> = None;
    for id in graph.node_ids() {
        let node = graph.node(id);
        if node.op.texture() != Some(texture) || !node.op.is_read() {
            continue;
        }
        if !matches!(node.op, Op::Load { .. }) || node.args.len() != 1 {
            return None;
        }
        let along = |axis: usize| match places[node.args[0].0 as usize][axis]? {
            Near(of, span) if of == axis => Some(span),
            Inside(of, span, to) if of == axis && (to.is_none() || to == own) => Some(span),
            _ => None,
        };
        let spans = [along(0)?, along(1)?];
        found = Some(match found {
            None => spans,
            Some(before) => [join(before[0], spans[0])?, join(before[1], spans[1])?],
        });
    }
    found
}

/// Both spans.
fn join(a: Span, b: Span) -> Option<Span> {
    let is_alike = (a.times, a.over) == (b.times, b.over);
    is_alike.then_some(Span {
        low: a.low.min(b.low),
        high: a.high.max(b.high),
        ..a
    })
}

/// Places of the first two components of each node.
fn follow_places<'a>(graph: &Graph, sizes: &Sizes<'a>) -> Vec<[Option<Place<'a>>; 2]> {
    let mut places: Vec<[Option<Place<'a>>; 2]> = Vec::with_capacity(graph.nodes.len());
    for id in graph.node_ids() {
        let node = graph.node(id);
        let is_integer = matches!(node.ty.scalar_kind(), Some(Scalar::I32 | Scalar::U32)) && !node.ty.is_array();
        let place = |component| component_place(node, component, &places, sizes).filter(is_near);
        places.push(match is_integer {
            true => [0, 1].map(place),
            false => [None; 2],
        });
    }
    places
}

/// Returns whether all numbers are far from wrapping.
fn is_near(place: &Place<'_>) -> bool {
    let within = |n: i64| (-FARTHEST..=FARTHEST).contains(&n);
    match *place {
        Number([low, high]) => within(low) && within(high),
        Near(_, span) | Inside(_, span, _) => {
            // The largest coordinate times this must not wrap either.
            within(span.low) && within(span.high) && span.times <= 64 && span.over <= FARTHEST
        }
        Side(_, _, n) => within(n),
    }
}

fn component_place<'a>(
    node: &Node,
    component: usize,
    places: &[[Option<Place<'a>>; 2]],
    sizes: &Sizes<'a>,
) -> Option<Place<'a>> {
    if component >= usize::from(node.ty.component_count()) {
        return None;
    }
    let whole = |id: NodeId, component: usize| places[id.0 as usize].get(component).copied().flatten();
    let arg = |k: usize| whole(node.args[k], component);
    Some(match &node.op {
        Op::Const(bits) => {
            let n = match node.ty.scalar_kind() {
                Some(Scalar::I32) => i64::from(bits[component] as i32),
                _ => i64::from(bits[component]),
            };
            Number([n, n])
        }
        Op::Pixel => Near(
            component,
            Span {
                times: 1,
                over: 1,
                low: 0,
                high: 0,
            },
        ),
        Op::FrameSize => Side(sizes.frame, component, 0),
        Op::TextureSize(texture) => Side(sizes.textures[*texture as usize].as_ref()?, component, 0),
        Op::Splat => whole(node.args[0], 0)?,
        Op::Compose => whole(node.args[component], 0)?,
        Op::Extract(of) => whole(node.args[0], usize::from(*of))?,
        Op::Tally(_) => arg(0)?,
        // The other kind of integer has the same value, if that is not negative.
        Op::Convert | Op::Bitcast => arg(0).filter(|place| !may_be_negative(place))?,
        Op::Unary(UnaryOp::Neg) => match arg(0)? {
            Number([low, high]) => Number([-high, -low]),
            _ => return None,
        },
        Op::Select => match (arg(1)?, arg(2)?) {
            (Number(a), Number(b)) => Number([a[0].min(b[0]), a[1].max(b[1])]),
            (Near(axis, a), Near(other, b)) if axis == other => Near(axis, join(a, b)?),
            (a, b) if a == b => a,
            _ => return None,
        },
        Op::Binary(op) => binary_place(*op, arg(0)?, arg(1)?)?,
        Op::Clamp => {
            let inside = binary_place(BinaryOp::Max, arg(0)?, arg(1)?)?;
            binary_place(BinaryOp::Min, inside, arg(2)?)?
        }
        _ => return None,
    })
}

fn may_be_negative(place: &Place<'_>) -> bool {
    match place {
        Number([low, _]) => *low < 0,
        Near(_, span) | Inside(_, span, _) => span.low < 0,
        Side(_, _, n) => *n < -1,
    }
}

fn binary_place<'a>(op: BinaryOp, a: Place<'a>, b: Place<'a>) -> Option<Place<'a>> {
    Some(match (op, a, b) {
        (BinaryOp::Add, Number([low, high]), other) | (BinaryOp::Add, other, Number([low, high])) => {
            moved(other, low, high)?
        }
        (BinaryOp::Sub, other, Number([low, high])) => moved(other, -high, -low)?,
        (BinaryOp::Mul, Number([m, same]), other) | (BinaryOp::Mul, other, Number([m, same])) if m == same => {
            multiplied(other, m)?
        }
        (BinaryOp::Div, other, Number([d, same])) if d == same && d > 0 => divided(other, d, may_be_negative(&other))?,
        // A shift rounds down.
        (BinaryOp::Shr, other, Number([shift, same])) if shift == same && (0..20).contains(&shift) => {
            divided(other, 1 << shift, false)?
        }
        (BinaryOp::Shl, other, Number([shift, same])) if shift == same && (0..20).contains(&shift) => {
            multiplied(other, 1 << shift)?
        }
        (BinaryOp::Rem, other, Number([d, same])) if d == same && d > 0 => match may_be_negative(&other) {
            true => Number([1 - d, d - 1]),
            false => Number([0, d - 1]),
        },
        (BinaryOp::And, Number([mask, same]), Number(_) | Near(..) | Inside(..))
        | (BinaryOp::And, Number(_) | Near(..) | Inside(..), Number([mask, same]))
            if mask == same && mask >= 0 =>
        {
            Number([0, mask])
        }
        (BinaryOp::Max, Number([0, 0]), other) | (BinaryOp::Max, other, Number([0, 0])) => match other {
            Near(axis, span) => Inside(axis, span, None),
            Inside(..) => other,
            Number(_) | Side(..) => return None,
        },
        (BinaryOp::Min, Side(size, side, -1), other) | (BinaryOp::Min, other, Side(size, side, -1)) => match other {
            Near(axis, span) if axis == side => Inside(axis, span, Some(size)),
            Inside(axis, span, to) if axis == side && to.is_none_or(|to| to == size) => Inside(axis, span, Some(size)),
            _ => return None,
        },
        _ => return None,
    })
}

/// A place plus a number from `low` to `high`.
fn moved(place: Place<'_>, low: i64, high: i64) -> Option<Place<'_>> {
    Some(match place {
        Number([from, to]) => Number([from + low, to + high]),
        Near(axis, span) => Near(
            axis,
            Span {
                low: span.low + low,
                high: span.high + high,
                ..span
            },
        ),
        Side(size, axis, n) if low == high => Side(size, axis, n + low),
        // A clamped coordinate has another distance at the border.
        Inside(..) => return (low == 0 && high == 0).then_some(place),
        Side(..) => return None,
    })
}

/// A place times a number.
fn multiplied(place: Place<'_>, by: i64) -> Option<Place<'_>> {
    Some(match place {
        Number([low, high]) => {
            let ends = [low * by, high * by];
            Number([ends[0].min(ends[1]), ends[0].max(ends[1])])
        }
        // A multiple of a rounded number is at most the rounded multiple, and less by less than the factor.
        Near(axis, span) if by > 0 => {
            let lost = if span.over == 1 { 0 } else { by - 1 };
            let scaled = scale(span.times * by, span.over);
            Near(
                axis,
                Span {
                    low: span.low * by - lost,
                    high: span.high * by,
                    ..scaled
                },
            )
        }
        _ => return None,
    })
}

/// A place over a number; `truncates` if it may be negative and is rounded towards 0.
fn divided(place: Place<'_>, by: i64, truncates: bool) -> Option<Place<'_>> {
    let up = i64::from(truncates);
    Some(match place {
        Number([low, high]) => Number([low.div_euclid(by), high.div_euclid(by) + up]),
        Near(axis, span) => Near(
            axis,
            Span {
                low: span.low.div_euclid(by),
                high: (span.high + by - 1).div_euclid(by) + up,
                ..scale(span.times, span.over * by)
            },
        ),
        _ => return None,
    })
}

/// A scale in lowest terms.
fn scale(times: i64, over: i64) -> Span {
    let (mut a, mut b) = (times, over);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    Span {
        times: times / a,
        over: over / a,
        low: 0,
        high: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::{Near, Number, Place, Span, binary_place};
    use crate::ir::BinaryOp;

    /// Every place that is followed holds for all pixels.
    #[test]
    fn places_hold_for_every_pixel() {
        let start = Near(
            0,
            Span {
                times: 1,
                over: 1,
                low: 0,
                high: 0,
            },
        );
        let steps: [(BinaryOp, i64); 8] = [
            (BinaryOp::Add, 3),
            (BinaryOp::Sub, 5),
            (BinaryOp::Mul, 2),
            (BinaryOp::Mul, 3),
            (BinaryOp::Div, 2),
            (BinaryOp::Div, 3),
            (BinaryOp::Shr, 1),
            (BinaryOp::Rem, 4),
        ];
        let mut state: u32 = 9;
        for _ in 0..4000 {
            let (mut place, mut values): (Option<Place<'_>>, Vec<i64>) = (Some(start), (0..100).collect());
            for _ in 0..4 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let (op, n) = steps[(state >> 16) as usize % steps.len()];
                place = place.and_then(|place| binary_place(op, place, Number([n, n])));
                values.iter_mut().for_each(|value| {
                    *value = match op {
                        BinaryOp::Add => *value + n,
                        BinaryOp::Sub => *value - n,
                        BinaryOp::Mul => *value * n,
                        BinaryOp::Div => *value / n,
                        BinaryOp::Shr => *value >> n,
                        _ => *value % n,
                    }
                });
            }
            let Some(place) = place else { continue };
            for (pixel, value) in (0..).zip(&values) {
                let (low, high) = match place {
                    Near(_, span) => {
                        let scaled = (span.times * pixel).div_euclid(span.over);
                        (scaled + span.low, scaled + span.high)
                    }
                    Number([low, high]) => (low, high),
                    other => panic!("{other:?}"),
                };
                assert!(
                    (low..=high).contains(value),
                    "{value} at {pixel}, not {low} to {high}: {place:?}"
                );
            }
        }
    }
}
