import * as z from 'zod/mini';

/** A robot's stable identity: a name that is valid in a URL, a topic and a file name. */
export const robotIdSchema = z
  .string()
  .check(
    z.regex(/^[a-z0-9][a-z0-9._-]{0,63}$/, 'must be 1–64 of a–z 0–9 . _ - beginning with a letter or digit'),
  );

/** A name for people to read. No control characters. */
export const displayNameSchema = z
  .string()
  .check(z.minLength(1), z.maxLength(64), z.regex(/^[^\p{Cc}]*$/u, 'must have no control characters'));

/** An opaque handle that one peer makes and others repeat. */
export const handleSchema = z
  .string()
  .check(z.regex(/^[A-Za-z0-9_-]{1,64}$/, 'must be 1–64 of A–Z a–z 0–9 _ -'));

export const tokenSchema = z.string().check(z.minLength(1), z.maxLength(4096));

export const uint32Schema = z.int().check(z.minimum(0), z.maximum(0xffffffff));
