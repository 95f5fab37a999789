import { chmodSync, statSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import {
  exportOperatorKey,
  importOperatorKey,
  keyThumbprint,
  makeIdentity,
  makeOperatorKey,
  type OperatorKey,
  operatorSecretJwkSchema,
  soleFingerprint,
} from '@farpoint/grants';
import { fileFault, type Logger, makeFolder, readTextFile, TextFileError } from '@farpoint/service';

/** The robot's key can be neither read nor made. The message says what to do, for people. */
export class RobotKeyError extends Error {
  override readonly name = 'RobotKeyError';
}

const LOST = 'Restore it, or delete it: then operators are asked whether they trust the new one';

/** The robot's own key, by which operators recognise it. */
export class RobotKey {
  /** SHA-256 of the public key (RFC 7638), for people to compare. */
  readonly thumbprint: string;
  readonly #key: OperatorKey;

  private constructor(key: OperatorKey, thumbprint: string) {
    this.#key = key;
    this.thumbprint = thumbprint;
  }

  /**
   * Reads the key, or makes one where the file does not exist. A key that cannot be read is never replaced: operators
   * would take the robot for another.
   *
   * @throws {RobotKeyError}
   */
  static async open(path: string): Promise<RobotKey> {
    let text: string;
    try {
      text = readTextFile(path);
    } catch (error) {
      if (!(error instanceof TextFileError)) throw error;
      if (error.code === 'ENOENT') return await RobotKey.#make(path);
      throw new RobotKeyError(
        error.code === null ? `${path} ${error.fault}. ${LOST}` : `${path} ${error.message}`,
      );
    }
    // Whoever reads the key can pretend to be this robot.
    if ((statSync(path).mode & 0o077) !== 0) chmodSync(path, 0o600);
    return await RobotKey.#of(await parse(path, text));
  }

  /** What the robot sends with a session's first offer; `undefined` if the offer names no certificate. */
  async identify(
    facts: { robot: string; session: string; offer: string },
    nowS: number,
  ): Promise<string | undefined> {
    const robotFingerprint = soleFingerprint(facts.offer);
    if (robotFingerprint === null) return undefined;
    const { robot, session } = facts;
    return await makeIdentity({ robot, session, robotFingerprint }, this.#key, nowS);
  }

  static async #of(key: OperatorKey): Promise<RobotKey> {
    return new RobotKey(key, await keyThumbprint(key.publicJwk));
  }

  static async #make(path: string): Promise<RobotKey> {
    const key = await makeOperatorKey(true);
    const text = `${JSON.stringify(await exportOperatorKey(key))}\n`;
    try {
      makeFolder(dirname(path), 0o750);
      // Two robots that start at once must not both believe in their own.
      writeFileSync(path, text, { mode: 0o600, flag: 'wx', flush: true });
    } catch (error) {
      throw new RobotKeyError(`${path} cannot be written: ${fileFault(error) ?? String(error)}`);
    }
    return await RobotKey.#of(key);
  }
}

async function parse(path: string, text: string): Promise<OperatorKey> {
  try {
    return await importOperatorKey(operatorSecretJwkSchema.parse(JSON.parse(text)));
  } catch {
    throw new RobotKeyError(`${path} is not a robot’s key. ${LOST}`);
  }
}

/** The robot's key, or `null`: without it, the robot goes on and says so. */
export async function openRobotKey(path: string, log: Logger): Promise<RobotKey | null> {
  try {
    const key = await RobotKey.open(path);
    log.info({ robotKey: key.thumbprint }, 'operators recognise this robot by its key');
    return key;
  } catch (error) {
    if (!(error instanceof RobotKeyError)) throw error;
    log.error({ detail: error.message }, 'the robot has no key: operators who know it will not connect');
    return null;
  }
}
