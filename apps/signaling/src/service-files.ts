import { createSecureContext } from 'node:tls';
import { OptionsError, readTextFile, TextFileError } from '@farpoint/service';
import { AccessList } from './access.ts';
import type { TlsFiles } from './listener.ts';
import type { SignalingOptions } from './options.ts';
import { parseTokens } from './token-file.ts';

/** The contents of the files that the options name; read at start and at each reload. */
export interface ServiceFiles {
  readonly tls: TlsFiles | null;
  readonly robots: AccessList;
  readonly operators: AccessList;
}

/**
 * Reads the certificate and tokens.
 *
 * @throws {OptionsError} naming the option whose file is missing or invalid
 */
export function readFiles(options: SignalingOptions): ServiceFiles {
  const { tlsCert, tlsKey, robotTokens, operatorTokens } = options;
  if ((tlsCert === null) !== (tlsKey === null)) {
    throw new OptionsError(
      tlsCert === null ? '--tls-key' : '--tls-cert',
      'needs the other one of --tls-cert and --tls-key',
    );
  }
  return {
    tls: tlsCert === null || tlsKey === null ? null : readTls(tlsCert, tlsKey),
    robots: readTokens('--robot-tokens', robotTokens, true),
    operators: readTokens('--operator-tokens', operatorTokens, false),
  };
}

function readTls(certPath: string, keyPath: string): TlsFiles {
  const tls = { cert: readOptionFile('--tls-cert', certPath), key: readOptionFile('--tls-key', keyPath) };
  try {
    createSecureContext(tls);
  } catch (error) {
    const detail = `are not a PEM certificate and its key: ${(error as Error).message}`;
    throw new OptionsError(`--tls-cert ${certPath} and --tls-key ${keyPath}`, detail);
  }
  return tls;
}

function readTokens(flag: string, path: string | null, bound: boolean): AccessList {
  if (path === null) return new AccessList(null);
  try {
    return new AccessList(parseTokens(readOptionFile(flag, path), bound));
  } catch (error) {
    if (error instanceof OptionsError) throw error;
    throw new OptionsError(`${flag}: ${path}`, (error as Error).message);
  }
}

function readOptionFile(flag: string, path: string): string {
  try {
    return readTextFile(path);
  } catch (error) {
    if (error instanceof TextFileError) throw new OptionsError(flag, error.message);
    throw error;
  }
}
