/** An error of the library, with its code and, for invalid input, the location in the file. */
export class SbfmtError extends Error {
  constructor(message, code, path) {
    super(message);
    this.name = 'SbfmtError';
    this.code = code;
    this.path = path;
  }
}
