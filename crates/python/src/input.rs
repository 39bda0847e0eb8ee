//! What is given: numbers, arrays and words of Python, refused where they are not what is asked for, under
//! the name of what they are for.

use crate::failure::Failure;
use eigenring_atlas::schemes::{MAX_VALENCE, setting};
use eigenring_scheme::Number;
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyInt, PyString};
use std::borrow::Cow;
use std::path::PathBuf;

/// The most of anything that is counted: places in lists have 32 bits, of which the last stands for none.
const MOST: u64 = u32::MAX as u64 - 1;

/// A whole number as it was given. An argument's type does not know what the number is for: what is none is
/// refused when the number is asked for.
#[derive(Clone, Debug)]
pub struct Whole(Result<u64, String>);

impl Whole {
    /// A number, as default of an argument.
    pub const fn of(number: u64) -> Self {
        Whole(Ok(number))
    }

    /// numpy's integers are whole numbers, True and 3.0 are not.
    fn read(given: &Bound<'_, PyAny>) -> Self {
        let number = || -> Option<u64> {
            if given.is_instance_of::<PyBool>() {
                return None;
            }
            let index = given.call_method0("__index__").ok()?;
            index.cast::<PyInt>().ok()?.extract().ok()
        };
        Whole(number().ok_or_else(|| shown(given)))
    }

    /// The number, up to a largest one.
    ///
    /// # Errors
    /// What is no whole number, and larger ones.
    pub fn up_to(self, most: u64, what: &str) -> Result<u64, Failure> {
        let refuse = |shown: String| {
            let accepted = format!("whole numbers from 0 to {most}");
            Failure::usage(format!("{what} is {shown}"), accepted)
        };
        match self.0 {
            Ok(number) if number <= most => Ok(number),
            Ok(number) => Err(refuse(number.to_string())),
            Err(shown) => Err(refuse(shown)),
        }
    }

    /// The number as a valence. Whether it is too small depends on what it is of.
    ///
    /// # Errors
    /// What is no whole number, and larger ones than the command takes.
    pub fn valence(self, what: &str) -> Result<usize, Failure> {
        Ok(self.up_to(MAX_VALENCE as u64, what)? as usize)
    }

    /// The number as a count.
    ///
    /// # Errors
    /// What is no whole number from 0 to 2^32 - 2.
    pub fn count(self, what: &str) -> Result<usize, Failure> {
        Ok(self.up_to(MOST, what)? as usize)
    }
}

impl<'py> FromPyObject<'_, 'py> for Whole {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Ok(Whole::read(&given))
    }
}

/// A count that may be left out.
///
/// # Errors
/// As [`Whole::count`].
pub fn count(given: Option<Whole>, what: &str) -> Result<Option<usize>, Failure> {
    given.map(|given| given.count(what)).transpose()
}

/// A real number as it was given, refused as [`Whole`] is.
#[derive(Clone, Debug)]
pub struct Real(Result<f64, String>);

impl Real {
    /// A number, as default of an argument.
    pub const fn of(number: f64) -> Self {
        Real(Ok(number))
    }

    fn read(given: &Bound<'_, PyAny>) -> Self {
        let refused = given.is_instance_of::<PyBool>() || given.is_instance_of::<PyString>();
        let number = if refused { None } else { given.extract().ok() };
        Real(number.ok_or_else(|| shown(given)))
    }

    /// The number, not finite only where `holds` says so of it.
    ///
    /// # Errors
    /// What is no number, or one for which `holds` does not hold.
    pub fn such(self, what: &str, accepted: &str, holds: impl Fn(f64) -> bool) -> Result<f64, Failure> {
        let refuse = |shown: String| Failure::usage(format!("{what} is {shown}"), accepted);
        match self.0 {
            Ok(number) if holds(number) => Ok(number),
            Ok(number) => Err(refuse(number.to_string())),
            Err(shown) => Err(refuse(shown)),
        }
    }

    /// The number.
    ///
    /// # Errors
    /// What is no finite number.
    pub fn finite(self, what: &str) -> Result<f64, Failure> {
        self.such(what, "finite numbers", f64::is_finite)
    }
}

impl<'py> FromPyObject<'_, 'py> for Real {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Ok(Real::read(&given))
    }
}

/// A value in a message of one line.
pub fn shown(given: &Bound<'_, PyAny>) -> String {
    const LONGEST: usize = 60;
    let text = match given.repr() {
        Ok(text) => text.to_string_lossy().into_owned(),
        Err(_) => format!("of {}", given.get_type()),
    };
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}..", &line[..end]),
        None => line,
    }
}

/// Text as it was given, refused as [`Whole`] is.
#[derive(Clone, Debug)]
pub struct Text(Result<Cow<'static, str>, String>);

impl Text {
    /// Text, as default of an argument.
    pub const fn of(text: &'static str) -> Self {
        Text(Ok(Cow::Borrowed(text)))
    }

    /// The text.
    ///
    /// # Errors
    /// What is no string, and strings that are no text, such as half a character.
    pub fn get(self, what: &str) -> Result<String, Failure> {
        let refuse = |shown| Failure::usage(format!("{what} is {shown}"), "text");
        self.0.map(Cow::into_owned).map_err(refuse)
    }
}

impl<'py> FromPyObject<'_, 'py> for Text {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Ok(Text(given.extract().map(Cow::Owned).map_err(|_| shown(&given))))
    }
}

/// Text that may be left out.
///
/// # Errors
/// As [`Text::get`].
pub fn text(given: Option<Text>, what: &str) -> Result<Option<String>, Failure> {
    given.map(|given| given.get(what)).transpose()
}

/// A path: text, or what Python takes for one.
///
/// # Errors
/// Anything else.
pub fn path(given: &Bound<'_, PyAny>, what: &str) -> Result<PathBuf, Failure> {
    let refuse = |_| Failure::usage(format!("{what} is {}", shown(given)), "a path");
    given.extract().map_err(refuse)
}

/// Parameters by name, as the command takes them, with their numbers in text.
///
/// # Errors
/// What is neither a number nor text of one.
pub fn settings(given: Option<&Bound<'_, PyDict>>) -> Result<Vec<(String, Number)>, Failure> {
    let accepted = "numbers, or fractions such as \"3/2\"";
    let items = given.into_iter().flatten();
    let parameter = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let name = key.extract::<Text>()?.get("the name of a parameter")?;
        let number = match value.cast::<PyString>() {
            Ok(_) => value.extract::<Text>()?.get(&name)?,
            // in the digits of Python, so that whole numbers may be of any size
            Err(_) if Real::read(&value).0.is_ok() => value.str()?.extract()?,
            Err(_) => return Err(Failure::usage(format!("{name} is {}", shown(&value)), accepted)),
        };
        let refuse = |reason| Failure::usage(reason, accepted);
        setting(&format!("{name}={number}")).map_err(refuse)
    };
    items.map(parameter).collect()
}

/// What a word stands for.
///
/// # Errors
/// Another word, with those that are known.
pub fn word<T: Copy>(what: &str, given: &str, words: &[(&str, T)]) -> Result<T, Failure> {
    match words.iter().find(|(word, _)| *word == given) {
        Some((_, value)) => Ok(*value),
        None => {
            let accepted: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            Err(Failure::usage(format!("{what} is '{given}'"), accepted.join(", ")))
        }
    }
}

/// An array of numpy's as it is, and what else numpy takes for one of real numbers.
fn array<'py>(
    given: &Bound<'py, PyAny>,
    refuse: &dyn Fn(String) -> Failure,
) -> Result<Bound<'py, PyUntypedArray>, Failure> {
    if let Ok(array) = given.cast::<PyUntypedArray>() {
        return Ok(array.clone());
    }
    let numpy = given.py().import("numpy")?;
    // ragged lists are refused by numpy, in words of several lines
    let told = |error: PyErr| refuse(shown(error.value(given.py()).as_any()));
    let array = numpy.call_method1("asarray", (given,)).map_err(told)?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    if !matches!(kind.as_str(), "f" | "i" | "u") {
        return Err(refuse(format!("{} is no list of numbers", shown(given))));
    }
    let array = numpy.call_method1("asarray", (array, "float64")).map_err(told)?;
    Ok(array.cast_into::<PyUntypedArray>().map_err(PyErr::from)?)
}

/// The entries of an array of numpy's, which must be float64, C-contiguous and finite.
fn entries(array: &Bound<'_, PyUntypedArray>, refuse: &dyn Fn(String) -> Failure) -> Result<Vec<f64>, Failure> {
    let Ok(numbers) = array.cast::<PyArrayDyn<f64>>() else {
        return Err(refuse(format!("the type of the entries is {}", array.dtype())));
    };
    if !array.is_c_contiguous() {
        return Err(refuse("the array is not contiguous".to_owned()));
    }
    // such as a view into bytes from an odd place on
    if !array.getattr("flags")?.getattr("aligned")?.extract::<bool>()? {
        return Err(refuse("the array is not aligned".to_owned()));
    }
    // what a mask hides would be taken for a number
    if array.getattr_opt("mask")?.is_some() {
        return Err(refuse("the array is masked".to_owned()));
    }
    let entries = numbers.to_vec().map_err(|error| refuse(error.to_string()))?;
    let Some(place) = entries.iter().position(|x| !x.is_finite()) else {
        return Ok(entries);
    };
    let (mut rest, mut indices) = (place, Vec::new());
    for &length in array.shape().iter().rev() {
        indices.insert(0, rest % length);
        rest /= length;
    }
    Err(refuse(format!("the entry {indices:?} is {}", entries[place])))
}

/// Entries of a float64 array of `columns` columns, checked; lists of numbers are made one.
///
/// # Errors
/// What is no such array, or holds numbers that are not finite.
pub fn rows(given: &Bound<'_, PyAny>, what: &str, columns: Option<usize>) -> Result<(Vec<f64>, usize, usize), Failure> {
    let accepted = match columns {
        Some(columns) => format!("a C-contiguous float64 array of shape (n, {columns}) with finite entries"),
        None => "a C-contiguous float64 array of shape (n, m) with finite entries".to_owned(),
    };
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), accepted.clone());
    let array = array(given, &refuse)?;
    match *array.shape() {
        [rows, width] if columns.is_none_or(|columns| columns == width) => Ok((entries(&array, &refuse)?, rows, width)),
        _ => Err(refuse(format!("the shape is {:?}", array.shape()))),
    }
}

/// One number or many: a one-dimensional float64 array, a list, or a number.
///
/// # Errors
/// What is none, or holds numbers that are not finite.
pub fn numbers(given: &Bound<'_, PyAny>, what: &str) -> Result<Vec<f64>, Failure> {
    let accepted = "finite numbers, as a C-contiguous float64 array of shape (n,) or a list";
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), accepted);
    let array = array(given, &refuse)?;
    // one of numpy's numbers is none of its arrays
    let alone = array.ndim() == 0 && given.cast::<PyUntypedArray>().is_err();
    match array.ndim() == 1 || alone {
        true => entries(&array, &refuse),
        false => Err(refuse(format!("the shape is {:?}", array.shape()))),
    }
}

/// So many numbers.
///
/// # Errors
/// As [`numbers`], and other counts of them.
pub fn exactly<const N: usize>(given: &Bound<'_, PyAny>, what: &str) -> Result<[f64; N], Failure> {
    let found = numbers(given, what)?;
    let count = found.len();
    let refuse = |_| Failure::usage(format!("{what}: {count} numbers"), format!("{N} finite numbers"));
    found.try_into().map_err(refuse)
}

/// Whole numbers, an integer array of any width or a list.
///
/// # Errors
/// What is no whole number from 0 to 2^32 - 2.
pub fn indices(given: &Bound<'_, PyAny>, what: &str) -> Result<Vec<u32>, Failure> {
    let accepted = format!("whole numbers from 0 to {MOST}");
    let refuse = |reason: String| Failure::usage(format!("{what}: {reason}"), accepted.clone());
    if let Ok(array) = given.cast::<PyUntypedArray>() {
        let kind: String = array.dtype().getattr("kind")?.extract()?;
        if kind != "i" && kind != "u" {
            return Err(refuse(format!("the type of the entries is {}", array.dtype())));
        }
        if array.ndim() != 1 {
            return Err(refuse(format!("the shape is {:?}", array.shape())));
        }
        // in the order of a list, whatever lies between the entries
        let wide = array
            .py()
            .import("numpy")?
            .call_method1("ascontiguousarray", (array, "int64"))?;
        let wide = wide.cast_into::<PyArray1<i64>>().map_err(PyErr::from)?;
        let wide = wide.readonly();
        let entries = wide.as_slice().map_err(|error| refuse(error.to_string()))?;
        let small = |&index: &i64| {
            let found = u32::try_from(index).ok().filter(|&index| u64::from(index) <= MOST);
            found.ok_or_else(|| refuse(index.to_string()))
        };
        return entries.iter().map(small).collect();
    }
    let items = given
        .try_iter()
        .map_err(|_| refuse(format!("{} is no list", shown(given))))?;
    items.map(|item| Ok(Whole::read(&item?).count(what)? as u32)).collect()
}

/// Valences: one, an integer array or a list.
///
/// # Errors
/// As [`indices`] and [`Whole::valence`].
pub fn valences(given: &Bound<'_, PyAny>) -> Result<Vec<usize>, Failure> {
    let found = match whole_or_many(given, "valences")? {
        Indices::One(number) => vec![number],
        Indices::Many(numbers) => numbers,
    };
    let valence = |number: u32| Whole::of(number.into()).valence("a valence");
    found.into_iter().map(valence).collect()
}

/// One whole number for all, or one for each.
pub enum Indices {
    /// For all.
    One(u32),
    /// For each.
    Many(Vec<u32>),
}

impl Indices {
    /// The number of the one with this place.
    pub fn at(&self, place: usize) -> u32 {
        match self {
            Indices::One(number) => *number,
            Indices::Many(numbers) => numbers[place],
        }
    }

    /// How many there are, if they are not one for all.
    pub fn count(&self) -> Option<usize> {
        match self {
            Indices::One(_) => None,
            Indices::Many(numbers) => Some(numbers.len()),
        }
    }
}

/// Whole numbers: as many as are given, or one.
///
/// # Errors
/// As [`indices`].
pub fn whole_or_many(given: &Bound<'_, PyAny>, what: &str) -> Result<Indices, Failure> {
    let many = match given.cast::<PyUntypedArray>() {
        Ok(array) => array.ndim() > 0,
        Err(_) => !given.is_instance_of::<PyString>() && given.try_iter().is_ok(),
    };
    Ok(match many {
        true => Indices::Many(indices(given, what)?),
        false => Indices::One(Whole::read(given).count(what)? as u32),
    })
}
