// Print the size of every public struct and the offset of every field, as the package has them.
import { STRUCTS } from '../lib/interface.js';

for (const [name, { size, fields }] of Object.entries(STRUCTS)) {
  console.log(name, size);
  for (const [field, [, offset]] of Object.entries(fields)) console.log(`${name}.${field}`, offset);
}
