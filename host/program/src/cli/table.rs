//! Tables and lines that fit the terminal.

use clap::Args;
use std::fmt::Display;
use std::io;
use terminal_size::{Width, terminal_size_of};
use textwrap::{Options, WordSplitter};
use unitvec_files::shown;
use unitvec_host::{Error, Result};

#[derive(Args)]
pub struct Wide {
    /// Print all columns, however narrow the terminal is; a file or a pipe gets all of them anyway. The variable
    /// UNITVEC_COLUMNS stands in for the terminal's width.
    #[arg(long)]
    wide: bool,
}

impl Wide {
    /// Characters that a line may have. `None`: no limit.
    ///
    /// # Errors
    /// As [`terminal_columns`].
    pub fn columns(&self) -> Result<Option<usize>> {
        if self.wide { Ok(None) } else { terminal_columns() }
    }
}

/// Characters in a line of the standard output where that is a terminal. UNITVEC_COLUMNS makes anything one: COLUMNS
/// does not, since where that is exported it would cut what scripts read.
///
/// # Errors
/// [`Error::Usage`] if UNITVEC_COLUMNS is not a number from 1.
pub fn terminal_columns() -> Result<Option<usize>> {
    let Some(columns) = super::variable("UNITVEC_COLUMNS") else {
        return Ok(terminal_size_of(io::stdout()).map(|(Width(columns), _)| columns.into()));
    };
    match columns.parse() {
        Ok(columns) if columns > 0 => Ok(Some(columns)),
        _ => Err(Error::Usage(format!(
            "UNITVEC_COLUMNS is `{columns}`; set it to a number from 1, or unset it"
        ))),
    }
}

/// Lines of prose broken between words to fit; what continues a line is `indent`ed.
pub fn wrapped(text: &str, indent: &str, columns: Option<usize>) -> String {
    let Some(columns) = columns else { return text.to_owned() };
    // Names have hyphens: in two parts they could be neither found nor copied.
    let options = Options::new(columns).subsequent_indent(indent).word_splitter(WordSplitter::NoHyphenation);
    text.split('\n').map(|line| textwrap::fill(line, &options)).collect::<Vec<_>>().join("\n")
}

pub struct Column {
    heading: String,
    width: usize,
    is_left: bool,
    gap: usize,
    rank: u32,
}

/// A column that is aligned to the left, as wide as its heading at least.
pub fn left(heading: &str, width: usize) -> Column {
    let width = heading.lines().map(str::len).fold(width, usize::max);
    Column { heading: heading.to_owned(), width, is_left: true, gap: 1, rank: 0 }
}

/// As [`left`], aligned to the right.
pub fn right(heading: &str, width: usize) -> Column {
    Column { is_left: false, ..left(heading, width) }
}

impl Column {
    /// The heading in one line; a word broken at its end is whole.
    #[cfg(feature = "lab")]
    pub fn title(&self) -> String {
        self.heading.replace("-\n", "").replace('\n', " ")
    }

    /// With a wide gap before it.
    pub fn apart(self) -> Self {
        Self { gap: 2, ..self }
    }

    /// With a rank: where room is short, columns of rank 1 get it first. Those without a rank are there always.
    pub fn rank(self, rank: u32) -> Self {
        Self { rank, ..self }
    }
}

/// The columns of a table, of which as many are shown as fit.
pub struct Layout {
    columns: Vec<(Column, bool)>,
}

impl Layout {
    /// With these columns, in lines of at most `width` characters.
    pub fn new(columns: Vec<Column>, width: Option<usize>) -> Self {
        let mut ranked: Vec<usize> = (0..columns.len()).collect();
        ranked.sort_by_key(|&at| columns[at].rank);
        let mut columns: Vec<_> = columns.into_iter().map(|column| (column, false)).collect();
        let mut taken = 0;
        for at in ranked {
            let (column, is_shown) = &mut columns[at];
            let with_it = taken + column.gap + column.width;
            // The first column has no gap: it is counted once too often, and one more character fits.
            *is_shown = column.rank == 0 || width.is_none_or(|width| with_it <= width.saturating_add(1));
            taken = if *is_shown { with_it } else { taken };
        }
        Self { columns }
    }

    /// Whether there was room for a column.
    #[cfg(feature = "lab")]
    pub fn shows(&self, column: usize) -> bool {
        self.columns.get(column).is_some_and(|(_, is_shown)| *is_shown)
    }

    /// Columns that are not shown.
    pub fn left_out(&self) -> usize {
        self.columns.iter().filter(|(_, is_shown)| !is_shown).count()
    }

    /// The headings, in as many lines as the longest has.
    pub fn heading(&self) -> String {
        let lines = self.columns.iter().map(|(column, _)| column.heading.lines().count()).max();
        let line = |at| {
            self.joined(|column| self.columns[column].0.heading.lines().nth(at).unwrap_or("").to_owned())
        };
        (0..lines.unwrap_or(0)).map(line).collect()
    }

    /// A line of the table: a cell for each column, shown or not.
    pub fn line(&self, cells: &[&dyn Display]) -> String {
        self.joined(|column| cells.get(column).map(shown).unwrap_or_default())
    }

    fn joined(&self, cell: impl Fn(usize) -> String) -> String {
        let mut line = String::new();
        for (at, (column, _)) in self.columns.iter().enumerate().filter(|(_, (_, is_shown))| *is_shown) {
            let (cell, width) = (cell(at), column.width);
            if !line.is_empty() {
                line += &" ".repeat(column.gap);
            }
            line += &if column.is_left { format!("{cell:<width$}") } else { format!("{cell:>width$}") };
        }
        line.trim_end().to_owned() + "\n"
    }
}

/// The last line under tables that leave columns out.
pub fn left_out(tables: &[&Layout]) -> String {
    match tables.iter().map(|table| table.left_out()).max() {
        None | Some(0) => String::new(),
        Some(1) => "\n1 column is left out here; --wide prints it\n".to_owned(),
        Some(count) => format!("\n{count} columns are left out here; --wide prints them\n"),
    }
}
