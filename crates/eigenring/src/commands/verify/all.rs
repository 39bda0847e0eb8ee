//! `eigenring verify --all`: the stored certificates and their summaries.
//!
//! An interrupted run resumes: certificates of ranges, which take longest, are kept below the output folder
//! until all are there.

use crate::error::Error;
use crate::files::{self, Written};
use crate::progress::Terminal;
use eigenring_atlas::certificates::{Ranged, range_table, ranges, singles, summary};
use eigenring_atlas::progress::each;
use eigenring_atlas::table::Format;
use eigenring_certify::certify;
use eigenring_certify::range::{Limits, RangeCertificate, prove_range};
use eigenring_certify::valences::{Family, LEAST, prove as prove_all};
use std::path::Path;
use std::process::ExitCode;

/// The folder below the output folder.
const FOLDER: &str = "certificates";

/// Makes and writes everything.
pub fn make(valences: &[usize], out: &Path, format: Format) -> Result<ExitCode, Error> {
    let folder = out.join(FOLDER);
    let (singles, ranges) = (singles(valences)?, ranges(valences)?);
    files::check_writable(out, &folder)?;
    let resume = folder.join(".resume");
    let singly = each(&Terminal, "certificates", &singles, |single| {
        certify(single.input.clone(), single.valence)
    })?;
    let ranged = each(&Terminal, "ranges of lambda", &ranges, |range| prove(range, &resume))?;
    let all = each(&Terminal, "all valences", &Family::ALL, |&family| {
        prove_all(family, LEAST)
    })?;
    let mut written = Written::default();
    for certificate in &all {
        let file = format!("all-valences/{}.json", certificate.scheme.name());
        written.write(folder.join(file), certificate.to_line()?.as_bytes())?;
    }
    for (single, certificate) in singles.iter().zip(&singly) {
        written.write(folder.join(&single.file), certificate.to_line()?.as_bytes())?;
    }
    for (range, certificate) in ranges.iter().zip(&ranged) {
        written.write(folder.join(&range.file), certificate.to_line()?.as_bytes())?;
    }
    let summary = summary(&singles, &singly);
    written.write(folder.join("summary.csv"), summary.render(Format::Csv).as_bytes())?;
    let table = range_table(&ranges, &ranged);
    written.write(folder.join("ranges.csv"), table.render(Format::Csv).as_bytes())?;
    // only now nothing is left to resume
    files::remove_folder(&resume)?;
    files::emit(None, table.render(format).as_bytes())?;
    written.say();
    Ok(ExitCode::SUCCESS)
}

/// The certificate of a range: what an interrupted run has left of it, if that is of the same curve, or a new
/// one.
fn prove(range: &Ranged, resume: &Path) -> Result<RangeCertificate, Error> {
    let path = resume.join(&range.file);
    if let Ok(text) = files::read(&path)
        && let Ok(kept) = RangeCertificate::from_json(&text)
        && range.is_proven_by(&kept)
    {
        return Ok(kept);
    }
    let certificate = prove_range(range.valence, range.curve.clone(), range.lambda, Limits::default())?;
    eigenring_atlas::files::write(&path, certificate.to_line()?.as_bytes())?;
    Ok(certificate)
}
