//! A model of time, linear in static counts with coefficients that are not negative, learned from some measured shaders.

/// Penalty of large coefficients, so that counts that go together share what they explain.
const RIDGE: f64 = 1.0e-6;

/// Rounds of coordinate descent.
const ROUNDS: usize = 20_000;

/// Nonnegative coefficients for which `rows · coefficients` comes closest to `times`, each error counted as a share of its
/// time (least squares by coordinate descent). Every row has as many figures; times are above 0.
pub fn fit_coefficients(rows: &[Vec<f64>], times: &[f64]) -> Vec<f64> {
    let width = rows.first().map_or(0, Vec::len);
    // Columns of like size: then the ridge holds all back alike.
    let scale: Vec<f64> = (0..width)
        .map(|k| rows.iter().map(|row| row[k]).fold(0.0, f64::max))
        .map(|largest| if largest > 0.0 { largest } else { 1.0 })
        .collect();
    let mean_time = times.iter().sum::<f64>() / times.len().max(1) as f64;
    let scaled: Vec<Vec<f64>> = rows
        .iter()
        .zip(times)
        .map(|(row, time)| (0..width).map(|k| row[k] / scale[k] * mean_time / time).collect())
        .collect();
    // The normal equations: gram · x = right, where every time is 1 after weighting.
    let mut gram = vec![vec![0.0; width]; width];
    let mut right = vec![0.0; width];
    for row in &scaled {
        for i in 0..width {
            right[i] += row[i];
            for j in 0..width {
                gram[i][j] += row[i] * row[j];
            }
        }
    }
    for (k, line) in gram.iter_mut().enumerate() {
        line[k] += RIDGE * rows.len() as f64;
    }
    let mut x = vec![0.0f64; width];
    for _ in 0..ROUNDS {
        let mut moved = 0.0f64;
        for k in 0..width {
            let others: f64 = (0..width).filter(|j| *j != k).map(|j| gram[k][j] * x[j]).sum();
            let next = ((right[k] - others) / gram[k][k]).max(0.0);
            moved = moved.max((next - x[k]).abs());
            x[k] = next;
        }
        if moved < 1.0e-13 {
            break;
        }
    }
    x.iter().zip(&scale).map(|(x, scale)| x * mean_time / scale).collect()
}

/// Returns the model's prediction.
pub fn predict_cost(coefficients: &[f64], row: &[f64]) -> f64 {
    coefficients.iter().zip(row).map(|(c, x)| c * x).sum()
}

/// Mean and largest of |predicted - measured| / measured; 0 of none.
pub fn relative_errors(predicted: &[f64], measured: &[f64]) -> (f64, f64) {
    let off = predicted.iter().zip(measured).map(|(p, m)| (p - m).abs() / m);
    let (sum, largest) = off.fold((0.0, 0.0f64), |(sum, largest), off| (sum + off, largest.max(off)));
    (sum / predicted.len().max(1) as f64, largest)
}

/// `count` of `rows` that span them: beginning with `taken`, always the one farthest from all that are taken. Columns are
/// compared as shares of their largest figure. Gives those that are new, in order.
pub fn choose_spanning(rows: &[Vec<f64>], taken: &[usize], count: usize) -> Vec<usize> {
    let width = rows.first().map_or(0, Vec::len);
    let largest: Vec<f64> = (0..width)
        .map(|k| rows.iter().map(|row| row[k].abs()).fold(f64::MIN_POSITIVE, f64::max))
        .collect();
    let distance = |a: &[f64], b: &[f64]| -> f64 { (0..width).map(|k| ((a[k] - b[k]) / largest[k]).powi(2)).sum() };
    let mut nearest = vec![f64::INFINITY; rows.len()];
    let update = |nearest: &mut Vec<f64>, chosen: usize| {
        for (near, row) in nearest.iter_mut().zip(rows) {
            *near = near.min(distance(row, &rows[chosen]));
        }
    };
    for index in taken {
        update(&mut nearest, *index);
    }
    let mut found = Vec::new();
    while found.len() < count {
        let farthest = (0..rows.len()).max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]).then(b.cmp(a)));
        match farthest {
            Some(index) if nearest[index] > 0.0 => {
                found.push(index);
                update(&mut nearest, index);
            }
            // The remaining rows have the figures of rows already taken.
            _ => break,
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(state: &mut u32) -> f64 {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(*state >> 8) / f64::from(1u32 << 24)
    }

    fn rows(count: usize, width: usize) -> Vec<Vec<f64>> {
        let mut state = 3;
        let sizes = [1.0, 40.0, 600.0, 9.0, 0.5];
        let row = |state: &mut u32| (0..width).map(|k| sizes[k] * (0.1 + random(state))).collect();
        (0..count).map(|_| row(&mut state)).collect()
    }

    #[test]
    fn known_coefficients_are_found_again() {
        let known = [3.0, 0.25, 0.01, 0.0, 7.0];
        let rows = rows(40, 5);
        let times: Vec<f64> = rows.iter().map(|row| predict_cost(&known, row)).collect();
        let found = fit_coefficients(&rows, &times);
        for (found, known) in found.iter().zip(known) {
            assert!((found - known).abs() <= 0.01 * known.max(0.1), "{found} for {known}");
        }
        let predicted: Vec<f64> = rows.iter().map(|row| predict_cost(&found, row)).collect();
        assert!(relative_errors(&predicted, &times).1 < 1.0e-3);
    }

    #[test]
    fn no_coefficient_is_negative_and_none_can_be_moved_for_the_better() {
        // A term that would want a negative coefficient: the second column shortens the time.
        let rows = rows(30, 3);
        let times: Vec<f64> = rows.iter().map(|r| 5.0 + r[0] - 0.05 * r[1] + 0.01 * r[2]).collect();
        let found = fit_coefficients(&rows, &times);
        assert!(found.iter().all(|c| *c >= 0.0), "{found:?}");
        let loss = |c: &[f64]| -> f64 {
            rows.iter()
                .zip(&times)
                .map(|(r, t)| (predict_cost(c, r) / t - 1.0).powi(2))
                .sum()
        };
        for k in 0..3 {
            for step in [0.9, 1.1] {
                let mut moved = found.clone();
                moved[k] = moved[k] * step + 1.0e-3 * (step - 0.9);
                assert!(loss(&moved) > loss(&found) - 1.0e-4, "{k} {step}: {found:?}");
            }
        }
    }

    #[test]
    fn a_count_that_is_never_there_explains_nothing() {
        let found = fit_coefficients(&[vec![1.0, 0.0], vec![2.0, 0.0], vec![4.0, 0.0]], &[3.0, 6.0, 12.0]);
        assert!((found[0] - 3.0).abs() < 1.0e-3 && found[1] == 0.0, "{found:?}");
    }

    #[test]
    fn the_farthest_are_taken_and_none_twice() {
        let rows: Vec<Vec<f64>> = [0.0, 1.0, 1.0, 9.0, 10.0, 5.0].map(|x| vec![x]).into();
        assert_eq!(choose_spanning(&rows, &[0], 2), [4, 5]);
        assert_eq!(choose_spanning(&rows, &[0], 99).len(), 4);
    }

    #[test]
    fn errors_are_shares() {
        let (mean, largest) = relative_errors(&[9.0, 12.0], &[10.0, 10.0]);
        assert!((mean - 0.15).abs() < 1e-12 && (largest - 0.2).abs() < 1e-12);
    }
}
