//! Description of the environment of a sweep.

use std::process::Command;
use straightline_study::record::Environment;

/// Collects the available facts; never fails.
pub fn collect_environment() -> Environment {
    let governor = std::fs::read_to_string("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor").ok();
    Environment {
        generator: env!("CARGO_PKG_VERSION").to_owned(),
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        governor: governor.map(|text| text.trim().to_owned()),
        commit: git_commit(),
    }
}

/// Returns the commit of the surrounding git repository, if any.
fn git_commit() -> Option<String> {
    let git = |words: &[&str]| {
        let output = Command::new("git").args(words).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let hash = git(&["rev-parse", "HEAD"])?;
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_none_or(|text| !text.is_empty());
    Some(hash + if changed { "+" } else { "" })
}
