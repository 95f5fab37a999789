import { spawnSync } from 'node:child_process';
import { join } from 'node:path';

/**
 * Creates a key and a self-signed certificate for one name in an existing folder: `key.pem`, `cert.pem`.
 *
 * @throws {Error} if openssl is missing or fails
 */
export function selfSigned(folder: string, name: string): { key: string; cert: string } {
  const [key, cert] = [join(folder, 'key.pem'), join(folder, 'cert.pem')];
  const kind = ['-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '2'];
  const names = ['-subj', `/CN=${name}`, '-addext', `subjectAltName=DNS:${name}`];
  const { status, stderr } = spawnSync(
    'openssl',
    ['req', '-x509', ...kind, '-keyout', key, '-out', cert, ...names],
    { encoding: 'utf8' },
  );
  if (status !== 0) throw new Error(`openssl: ${stderr}`);
  return { key, cert };
}
