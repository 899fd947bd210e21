/** What the library refuses, with its code and, where the input is at fault, the place in the file. */
export class SbfmtError extends Error {
  constructor(message, code, path) {
    super(message);
    this.name = 'SbfmtError';
    this.code = code;
    this.path = path;
  }
}
