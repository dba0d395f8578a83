//! Pareto fronts: what no other is better than in both time and error.

/// Returns for each of some (time, loss) pairs whether it is on the front: no other is as good in both and better in one. Of
/// equals all are.
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<bool> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (points[*a], points[*b]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut on = vec![false; points.len()];
    let mut best: Option<(f64, f64)> = None;
    for index in order {
        let (time, loss) = points[index];
        let better = best.is_none_or(|(fastest, least)| loss < least || (loss == least && time == fastest));
        if better {
            on[index] = true;
            best = Some((time, loss));
        }
    }
    on
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_that_of_brute_force() {
        let mut state = 7u32;
        let mut random = |n: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from((state >> 16) % n)
        };
        for round in 0..200 {
            // Few different numbers, so that many are equal.
            let points: Vec<(f64, f64)> = (0..round % 30).map(|_| (random(8), random(8))).collect();
            let beaten = |p: &(f64, f64)| {
                points
                    .iter()
                    .any(|q| q.0 <= p.0 && q.1 <= p.1 && (q.0 < p.0 || q.1 < p.1))
            };
            let expected: Vec<bool> = points.iter().map(|p| !beaten(p)).collect();
            assert_eq!(pareto_front(&points), expected, "{points:?}");
        }
    }
}
