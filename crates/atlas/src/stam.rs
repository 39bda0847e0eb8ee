//! Stam's evaluation basis as a file, and reading it back.
//!
//! JSON: `scheme`, `valence`, `layout` (`2N+8` or `6N+1` points), `points`, `eigenvalues`, `inverse` (a row
//! for each eigenvalue, a column for each point), `patches` (p, q in the units of the layout) and
//! `coefficients` (patch, eigenvalue, 16 control values of uniform bicubic B-splines, 4 along s for each of 4
//! along t). NumPy: one array with a row for each eigenvalue, which holds the eigenvalue, its row of the
//! inverse, and its coefficients patch by patch. What they mean: [`Stam`].

use crate::error::{Accepted, Error};
use crate::matrix::npy as array;
use crate::numbers::{self, Called};
use eigenring_scheme::Scheme;
use eigenring_spectral::{Extended, Matrix, Stam, stam_points};
use serde::Deserialize;
use serde_json::{Value, json};

/// The largest valence: Stam's own tables end at 50.
pub const MAX_VALENCE: usize = 64;

/// The basis of a scheme.
///
/// # Errors
/// [`Error::Content`] for a valence beyond [`MAX_VALENCE`]; those of [`Stam::new`].
pub fn basis(scheme: &Scheme<f64>, extended: Option<&Scheme<Extended>>) -> Result<Stam, Error> {
    let valence = scheme.limit().fan().sectors();
    if !(3..=MAX_VALENCE).contains(&valence) || !scheme.limit().fan().is_closed() {
        return Err(Error::refused(
            format!("Stam's basis at valence {valence}"),
            Accepted::Are(format!("closed corners of valence 3 to {MAX_VALENCE}")),
        ));
    }
    Ok(Stam::new(scheme, extended)?)
}

/// What JSON holds, and how it is read.
#[derive(Deserialize)]
struct File {
    valence: usize,
    eigenvalues: Vec<f64>,
    inverse: Vec<Vec<f64>>,
    coefficients: Vec<Vec<[f64; 16]>>,
}

/// The basis as a JSON object.
pub fn json(stam: &Stam, scheme: &str) -> Value {
    let points: Vec<Value> = stam_points(stam.valence, stam.is_regular())
        .into_iter()
        .map(|site| {
            let name = match (site.x / 2, site.y / 2) {
                (0, 0) => "V".to_owned(),
                (x, y) => format!("P_{}({x},{y})", site.sector),
            };
            json!({"name": name, "sector": site.sector, "x": site.x / 2, "y": site.y / 2})
        })
        .collect();
    let rows: Vec<&[f64]> = (0..stam.inverse.rows()).map(|i| stam.inverse.row(i)).collect();
    json!({
        "scheme": scheme,
        "valence": stam.valence,
        "layout": if stam.is_regular() { "2N+8" } else { "6N+1" },
        "points": points,
        "eigenvalues": stam.eigenvalues,
        "inverse": rows,
        "patches": stam.patches,
        "coefficients": stam.coefficients,
    })
}

/// The basis in NumPy's format.
pub fn npy(stam: &Stam) -> Vec<u8> {
    let count = stam.eigenvalues.len();
    let row = |i: usize| {
        let functions = stam.coefficients.iter().flat_map(move |patch| patch[i]);
        let inverse = stam.inverse.row(i).iter().copied();
        std::iter::once(stam.eigenvalues[i]).chain(inverse).chain(functions)
    };
    let entries: Vec<f64> = (0..count).flat_map(row).collect();
    array(&[count, 1 + count + 16 * stam.patches.len()], entries.into_iter())
}

/// Reads either format.
///
/// # Errors
/// [`Error::Content`] for what is none of them, with the shape that is accepted.
pub fn read(bytes: &[u8]) -> Result<Stam, Error> {
    let refuse = |message: String| {
        let accepted =
            "what 'eigenring eigenvectors --stam' writes: K = 2N+8 eigenvalues with 3 patches, or 6N+1 with 12";
        Error::refused(message, Accepted::Are(accepted.to_owned()))
    };
    let file = if bytes.trim_ascii_start().starts_with(b"{") {
        serde_json::from_slice::<File>(bytes).map_err(|error| refuse(error.to_string()))?
    } else {
        let rows = numbers::read(bytes, Called::Row)?.rows;
        let count = rows.len();
        let patches = rows.first().map_or(0, |row| row.len().saturating_sub(1 + count) / 16);
        let valence = match patches {
            3 => count.saturating_sub(8) / 2,
            _ => count.saturating_sub(1) / 6,
        };
        if rows.iter().any(|row| row.len() != 1 + count + 16 * patches) {
            return Err(refuse(format!("{count} rows of other lengths")));
        }
        let function = |row: &Vec<f64>, patch: usize| {
            let start = 1 + count + 16 * patch;
            std::array::from_fn(|i| row[start + i])
        };
        File {
            valence,
            eigenvalues: rows.iter().map(|row| row[0]).collect(),
            inverse: rows.iter().map(|row| row[1..=count].to_vec()).collect(),
            coefficients: (0..patches)
                .map(|patch| rows.iter().map(|row| function(row, patch)).collect())
                .collect(),
        }
    };
    let (count, n) = (file.eigenvalues.len(), file.valence);
    let inner = match file.coefficients.len() {
        3 if n >= 3 && count.checked_sub(8) == n.checked_mul(2) => 1,
        12 if n >= 3 && count.checked_sub(1) == n.checked_mul(6) => 2,
        patches => {
            return Err(refuse(format!(
                "{count} eigenvalues and {patches} patches at valence {n}"
            )));
        }
    };
    let whole = file.inverse.len() == count && file.inverse.iter().all(|row| row.len() == count);
    if !whole || file.coefficients.iter().any(|patch| patch.len() != count) {
        return Err(refuse(format!("not {count} numbers for each of {count} eigenvalues")));
    }
    let numbers = file.eigenvalues.iter().chain(file.inverse.iter().flatten());
    if numbers
        .chain(file.coefficients.iter().flatten().flatten())
        .any(|x| !x.is_finite())
    {
        return Err(refuse("a number that is not finite".to_owned()));
    }
    // counted by q and then by p, as in the annulus
    let places = (0..2 * inner).flat_map(|q| (0..2 * inner).map(move |p| [p, q]));
    Ok(Stam {
        valence: n,
        eigenvalues: file.eigenvalues,
        inverse: Matrix::from_rows(file.inverse, count),
        patches: places.filter(|&[p, q]| p.max(q) >= inner).collect(),
        coefficients: file.coefficients,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schemes::{SchemeName, Tuner};

    #[test]
    fn files_are_read_back_to_the_same_numbers() {
        for (spec, valence) in [("catmull-clark", 3), ("catmull-clark", 8), ("lambda:optimal", 5)] {
            let name = spec.parse::<SchemeName>().unwrap();
            let scheme = name.scheme(valence, &Tuner::default()).unwrap();
            let stam = basis(&scheme, None).unwrap();
            let text = json(&stam, spec).to_string();
            assert_eq!(read(text.as_bytes()).unwrap(), stam);
            assert_eq!(read(&npy(&stam)).unwrap(), stam);
            // planted faults
            let mut short: Value = serde_json::from_str(&text).unwrap();
            short["eigenvalues"].as_array_mut().unwrap().pop();
            assert!(read(short.to_string().as_bytes()).is_err());
            assert!(read(&npy(&stam)[..2000]).is_err());
        }
        assert!(read(b"{}").is_err() && read(b"1,2\n3,4\n").is_err());
    }
}
