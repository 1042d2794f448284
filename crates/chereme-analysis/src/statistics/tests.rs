mod laws;
mod lexica;
mod vectors;
