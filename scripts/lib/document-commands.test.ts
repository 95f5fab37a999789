import { expect, test } from 'vitest';
import { documentCommands, shellWords } from './document-commands.ts';

const markdown = `# Title
Try \`pnpm bench mtp\` or \`node\`, not \`a.b\`.

\`\`\`sh
pnpm dev                # the stack
docker run -d \\
  -v a:b \\
  image
sudo install /dev/stdin x <<'ENV'
pnpm not-a-command
ENV
# a comment alone

pnpm robot --name "Behind 8"
\`\`\`

\`\`\`yaml
pnpm: not shell
\`\`\`
1. listed:
   \`\`\`sh
   farpoint-robot doctor
   \`\`\`
`;

test('finds commands in fenced shell blocks and in prose', () => {
  expect(documentCommands(markdown)).toEqual([
    { text: 'pnpm bench mtp', line: 2 },
    { text: 'pnpm dev', line: 5 },
    { text: 'docker run -d -v a:b image', line: 6 },
    { text: "sudo install /dev/stdin x <<'ENV'", line: 9 },
    { text: 'pnpm robot --name "Behind 8"', line: 14 },
    { text: 'farpoint-robot doctor', line: 22 },
  ]);
});

test('splits words as a shell does', () => {
  expect(shellWords('pnpm robot --name "Behind 8 Mbit/s" --id \'a b\' x')).toEqual([
    'pnpm',
    'robot',
    '--name',
    'Behind 8 Mbit/s',
    '--id',
    'a b',
    'x',
  ]);
});
