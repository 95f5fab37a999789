/** The keys by which an operator recognises robots. A robot's key is remembered at the first session with it. */
export interface KnownRobots {
  /** @returns the thumbprint of the robot's key; `undefined` for a robot that is not known */
  get(robotId: string): string | undefined;
  /**
   * The robot proved that it has this key. Called once per session, also for keys that are known.
   *
   * @param thumbprint SHA-256 of the public key in base64url (RFC 7638)
   */
  remember(robotId: string, thumbprint: string): void;
}

/** Remembers robots until the page is closed. @param keys thumbprints that are known already, by robot id */
export function knownInMemory(keys: Readonly<Record<string, string>> = {}): KnownRobots {
  const known = new Map(Object.entries(keys));
  return {
    get: (robotId) => known.get(robotId),
    remember: (robotId, thumbprint) => void known.set(robotId, thumbprint),
  };
}
