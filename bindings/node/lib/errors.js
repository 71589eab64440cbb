// Exceptions: a class for each status of the library, all of them LocusError.
import { Status } from './constants.js';

/** The shared library was not found, or is of a version this package cannot work with. */
export class LibraryError extends Error {
  name = 'LibraryError';
}

/** A call of the library failed: the message names the function, the argument and the offending value. */
export class LocusError extends Error {
  name = 'LocusError';

  /**
   * @param {string} message
   * @param {number} status a number of `Status`
   * @param {string} code its name, such as LOCUS_E_RANGE
   */
  constructor(message, status, code) {
    super(message);
    this.status = status;
    this.code = code;
  }
}

/** An argument is out of its range or contradicts another one. */
export class ArgumentError extends LocusError {
  name = 'ArgumentError';
}

/** A value cannot be represented in the words the object was created with. */
export class ValueRangeError extends LocusError {
  name = 'ValueRangeError';
}

/** The caller's memory is too small. */
export class CapacityError extends LocusError {
  name = 'CapacityError';
}

/** The object is not in a state that allows the call. */
export class StateError extends LocusError {
  name = 'StateError';
}

/** Not available in this build, on this machine, or in this form of the call. */
export class UnsupportedError extends LocusError {
  name = 'UnsupportedError';
}

/** A callback asked to stop, or the work was cancelled. */
export class StoppedError extends LocusError {
  name = 'StoppedError';
}

/** Another call is at work on the object that excludes this one. */
export class BusyError extends LocusError {
  name = 'BusyError';
}

/** The snapshot outlived its memory budget. */
export class StaleError extends LocusError {
  name = 'StaleError';
}

/** Out of memory. */
export class OutOfMemoryError extends LocusError {
  name = 'OutOfMemoryError';
}

/** The operating system refused to read or write. */
export class IoError extends LocusError {
  name = 'IoError';
}

/** Bytes from outside are not what they claim to be. */
export class FormatError extends LocusError {
  name = 'FormatError';
}

/** The GPU or its driver reported an error. */
export class DeviceError extends LocusError {
  name = 'DeviceError';
}

/** A defect in Locus; please report the text. */
export class InternalError extends LocusError {
  name = 'InternalError';
}

const CLASSES = new Map([
  [Status.ARGUMENT, ArgumentError],
  [Status.RANGE, ValueRangeError],
  [Status.CAPACITY, CapacityError],
  [Status.STATE, StateError],
  [Status.UNSUPPORTED, UnsupportedError],
  [Status.STOPPED, StoppedError],
  [Status.BUSY, BusyError],
  [Status.STALE, StaleError],
  [Status.MEMORY, OutOfMemoryError],
  [Status.IO, IoError],
  [Status.FORMAT, FormatError],
  [Status.DEVICE, DeviceError],
  [Status.INTERNAL, InternalError],
]);

/** The error of a status; LocusError itself for one that a later library has added. */
export function errorFor(status, text, code) {
  const kind = CLASSES.get(status) ?? LocusError;
  return new kind(text, status, code);
}

/** The error of a call that this package itself refuses. */
export function refusal(name, text) {
  return errorFor(Status[name], text, `LOCUS_E_${name}`);
}
