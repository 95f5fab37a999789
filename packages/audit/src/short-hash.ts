import { createHash } from 'node:crypto';

/**
 * Names a secret without telling it: the first 12 hexadecimal digits of the SHA-256 of purpose and text. The same
 * session has the same name in every log. A secret that can be guessed can also be recognised.
 */
export function shortHash(purpose: 'session' | 'token', text: string): string {
  return createHash('sha256').update(`farpoint ${purpose}\n${text}`).digest('hex').slice(0, 12);
}
