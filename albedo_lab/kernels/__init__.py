"""How formulas become machine code: jit policy, vector maths, uniforms, specialisation, templates."""
