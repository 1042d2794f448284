//! Writes a Parquet file group by group.
//!
//! The same table always gives the same bytes: the file contains neither a time nor a path.

use std::io::{self, Write};
use std::sync::{Arc, Mutex};

use ::parquet::basic::{Compression, ConvertedType, Encoding, Repetition, Type as Physical, ZstdLevel};
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{WriterProperties, WriterPropertiesPtr};
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnPath, Type, TypePtr};

use crate::error::{CorpusError, CorpusResult};

/// The cells of a column; a gap is null.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ParquetCells {
    Text(Vec<Option<ByteArray>>),
    Double(Vec<Option<f64>>),
    Integer(Vec<Option<i64>>),
    Flag(Vec<Option<bool>>),
    /// Numbers of movement, without gaps.
    Float(Vec<f32>),
}

impl ParquetCells {
    pub(super) fn push_text(&mut self, text: Option<&str>) {
        if let Self::Text(cells) = self {
            cells.push(text.map(ByteArray::from));
        }
    }

    pub(super) fn push_integer(&mut self, number: Option<i64>) {
        if let Self::Integer(cells) = self {
            cells.push(number);
        }
    }

    pub(super) fn push_double(&mut self, number: Option<f64>) {
        if let Self::Double(cells) = self {
            cells.push(number);
        }
    }
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ParquetColumn {
    pub(super) name: String,
    pub(super) cells: ParquetCells,
}

impl ParquetColumn {
    pub(super) fn new(name: &str, cells: ParquetCells) -> Self {
        Self {
            name: name.to_owned(),
            cells,
        }
    }
}

/// A set of rows, stored column by column.
pub(super) type ParquetTable = Vec<ParquetColumn>;

/// A file under construction.
pub(super) struct ParquetFileWriter<'o> {
    held: PendingBytes,
    out: &'o mut dyn Write,
    file: SerializedFileWriter<PendingBytes>,
}

impl<'o> ParquetFileWriter<'o> {
    /// Begins a file with the columns of a table; `about` describes the columns in the metadata.
    pub(super) fn new(table: &ParquetTable, about: &str, out: &'o mut dyn Write) -> CorpusResult<Self> {
        let pending = PendingBytes::default();
        let properties = parquet_writer_properties(table, about)?;
        let file = SerializedFileWriter::new(pending.clone(), parquet_schema(table)?, properties);
        Ok(Self {
            file: file.map_err(parquet_write_error)?,
            held: pending,
            out,
        })
    }

    /// Writes the rows of a table as a group.
    pub(super) fn write_row_group(&mut self, table: &ParquetTable) -> CorpusResult<()> {
        let mut group = self.file.next_row_group().map_err(parquet_write_error)?;
        for column in table {
            let Some(mut writer) = group.next_column().map_err(parquet_write_error)? else {
                break;
            };
            let written = match &column.cells {
                ParquetCells::Text(cells) => with_gaps::<ByteArrayType>(&mut writer, cells),
                ParquetCells::Double(cells) => with_gaps::<DoubleType>(&mut writer, cells),
                ParquetCells::Integer(cells) => with_gaps::<Int64Type>(&mut writer, cells),
                ParquetCells::Flag(cells) => with_gaps::<BoolType>(&mut writer, cells),
                ParquetCells::Float(cells) => writer.typed::<FloatType>().write_batch(cells, None, None),
            };
            written.map_err(parquet_write_error)?;
            writer.close().map_err(parquet_write_error)?;
        }
        group.close().map_err(parquet_write_error)?;
        // A file of many groups would otherwise lie in memory whole.
        self.drain()
    }

    /// Ends the file.
    pub(super) fn finish_parquet_file(mut self) -> CorpusResult<()> {
        self.file.finish().map_err(parquet_write_error)?;
        self.drain()
    }

    /// Writes the bytes so far to the output.
    fn drain(&mut self) -> CorpusResult<()> {
        let taken = self.held.0.lock().map(|mut held| std::mem::take(&mut *held));
        let bytes = taken.map_err(|_| parquet_output_error(&io::Error::other("the writer failed")))?;
        self.out.write_all(&bytes).map_err(|error| parquet_output_error(&error))
    }
}

/// Writes the cells that have a value, and for each row whether it has one.
fn with_gaps<T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    cells: &[Option<T::T>],
) -> std::result::Result<usize, ParquetError> {
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
    let there: Vec<T::T> = cells.iter().flatten().cloned().collect();
    writer.typed::<T>().write_batch(&there, Some(&levels), None)
}

fn parquet_schema(table: &ParquetTable) -> CorpusResult<TypePtr> {
    let fields: CorpusResult<Vec<TypePtr>> = table
        .iter()
        .map(|column| {
            let (physical, repetition) = match column.cells {
                ParquetCells::Text(_) => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
                ParquetCells::Double(_) => (Physical::DOUBLE, Repetition::OPTIONAL),
                ParquetCells::Integer(_) => (Physical::INT64, Repetition::OPTIONAL),
                ParquetCells::Flag(_) => (Physical::BOOLEAN, Repetition::OPTIONAL),
                ParquetCells::Float(_) => (Physical::FLOAT, Repetition::REQUIRED),
            };
            let kind = if physical == Physical::BYTE_ARRAY {
                ConvertedType::UTF8
            } else {
                ConvertedType::NONE
            };
            let field = Type::primitive_type_builder(&column.name, physical)
                .with_repetition(repetition)
                .with_converted_type(kind)
                .build();
            Ok(Arc::new(field.map_err(parquet_write_error)?))
        })
        .collect();
    let group_type = Type::group_type_builder("chereme").with_fields(fields?).build();
    Ok(Arc::new(group_type.map_err(parquet_write_error)?))
}

/// Returns the encodings of columns: dictionaries for texts, byte stream split for numbers of movement.
fn parquet_writer_properties(table: &ParquetTable, about: &str) -> CorpusResult<WriterPropertiesPtr> {
    let level = ZstdLevel::try_new(3).map_err(parquet_write_error)?;
    let about = KeyValue::new("chereme".to_owned(), about.to_owned());
    let mut builder = WriterProperties::builder()
        .set_created_by(format!("Chereme {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(vec![about]))
        .set_compression(Compression::ZSTD(level));
    for column in table {
        let path = ColumnPath::from(column.name.as_str());
        // Numbers of movement hardly repeat, so a dictionary would only cost room.
        if matches!(column.cells, ParquetCells::Float(_)) {
            builder = builder
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
        }
    }
    Ok(Arc::new(builder.build()))
}

/// The bytes of a file under construction that have not been written out yet.
#[derive(Clone, Default)]
struct PendingBytes(Arc<Mutex<Vec<u8>>>);

impl Write for PendingBytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let lock_result = self.0.lock();
        let mut buffer = lock_result.map_err(|_| io::Error::other("the writer failed"))?;
        buffer.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn parquet_write_error(error: ParquetError) -> CorpusError {
    CorpusError::from_wrong_message(format!("the table cannot be written: {error}"))
}

fn parquet_output_error(error: &io::Error) -> CorpusError {
    CorpusError::from_wrong_message(format!("the table cannot be written: {error}"))
}
