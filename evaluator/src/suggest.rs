//! Names that were meant.

/// Help for an unknown name: the name that was probably meant, or the known ones, nearest first.
pub fn suggest_name(name: &str, known: &[&str], has: &str) -> String {
    match known.iter().find(|k| **k != name && is_close(name, k)) {
        Some(close) => format!("did you mean `{close}`?"),
        None if known.is_empty() => "check its name".to_owned(),
        None => {
            let more = if known.len() > 12 { ", ..." } else { "" };
            let mut nearest = known.to_vec();
            nearest.sort_by_key(|known| edit_distance(name, known));
            nearest.truncate(12);
            format!("{has} {}{more}", nearest.join(", "))
        }
    }
}

/// Returns whether a name may be another one misspelt.
pub fn is_close(name: &str, known: &str) -> bool {
    edit_distance(name, known) <= (1 + name.len() / 5).min(name.len().saturating_sub(1))
}

/// Letters to be changed, added, left out or exchanged with the next one.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![(0..=b.len()).collect::<Vec<usize>>()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = change.min(row[j - 1] + 1).min(rows[i - 1][j] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}
