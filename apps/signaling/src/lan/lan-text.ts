import { renderUnicodeCompact } from 'uqr';
import type { Lan } from './lan.ts';

/** What the terminal shows: how a headset gets here, in the order in which it is done. */
export function lanText({ addresses, installAddress, fingerprint }: Lan): string {
  const [first = '', ...others] = addresses;
  const code = renderUnicodeCompact(installAddress)
    .split('\n')
    .map((line) => `  ${line}`)
    .join('\n');
  return `
${code}

  On a headset or a phone, once   ${installAddress}
  then                            ${first}
${others.map((each) => `  or                              ${each}`).join('\n')}

  SHA-256 of the certificate to install:
  ${fingerprint}
`;
}
