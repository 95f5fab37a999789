/** The two ClientHello messages (RFC 6347 §4.2.1): the second repeats the first and adds the server's cookie. */

export interface SplitHello {
  /** Everything but the cookie. */
  rest: Buffer;
  cookie: Buffer;
}

/** @returns `null` if the body is no ClientHello */
export function splitClientHello(body: Buffer): SplitHello | null {
  const sessionIdAt = 2 + 32;
  if (body.length <= sessionIdAt) return null;
  const cookieAt = sessionIdAt + 1 + body.readUInt8(sessionIdAt);
  if (body.length <= cookieAt) return null;
  const suitesAt = cookieAt + 1 + body.readUInt8(cookieAt);
  if (body.length <= suitesAt) return null;
  return {
    rest: Buffer.concat([body.subarray(0, cookieAt), body.subarray(suitesAt)]),
    cookie: body.subarray(cookieAt + 1, suitesAt),
  };
}

/** Whether the second hello equals the first except for this cookie. */
export function repeatsWithCookie(first: Buffer, second: Buffer, cookie: Buffer): boolean {
  const [a, b] = [splitClientHello(first), splitClientHello(second)];
  return a !== null && b !== null && a.rest.equals(b.rest) && b.cookie.length > 0 && b.cookie.equals(cookie);
}
