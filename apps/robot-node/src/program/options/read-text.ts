import { X509Certificate } from 'node:crypto';
import { readTextFile, TextFileError } from '@farpoint/service';

/** The text of a file that an option names, never blank; `null` after a refusal. */
export function readText(path: string, refuse: (detail: string) => void): string | null {
  try {
    return readTextFile(path);
  } catch (error) {
    if (!(error instanceof TextFileError)) throw error;
    refuse(error.message);
    return null;
  }
}

const CERTIFICATE =
  /-----BEGIN (?:TRUSTED |X509 )?CERTIFICATE-----[^-]+-----END (?:TRUSTED |X509 )?CERTIFICATE-----/g;

/** Certificates (PEM), at least one, each of which can be read; `null` without a path and after a refusal. */
export function readCertificates(path: string | null, refuse: (detail: string) => void): string | null {
  const text = path === null ? null : readText(path, refuse);
  if (text === null) return null;
  const found = text.match(CERTIFICATE) ?? [];
  if (found.length === 0) refuse(`names a file without a certificate (PEM): ${path}`);
  const broken = found.findIndex((pem) => !isCertificate(pem));
  if (broken >= 0) refuse(`names a file whose certificate ${broken + 1} cannot be read: ${path}`);
  return found.length === 0 || broken >= 0 ? null : text;
}

function isCertificate(pem: string): boolean {
  try {
    return new X509Certificate(pem).subject !== undefined;
  } catch {
    return false;
  }
}
