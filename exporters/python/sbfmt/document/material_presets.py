"""Attributes of materials by name. Generated from spec/sbf.materials by spec/generate/generate.py; do not edit."""

MATERIALS = {
    'cotton': {'density': 500, 'young_modulus': 1e7, 'poisson_ratio': 0.3, 'damping_ratio': 0.1, 'friction': 0.5, 'area_density': 0.15, 'thickness': 0.0003, 'bending_stiffness': 7e-6},
    'denim': {'density': 400, 'young_modulus': 1.5e7, 'poisson_ratio': 0.25, 'damping_ratio': 0.15, 'friction': 0.6, 'area_density': 0.4, 'thickness': 0.001, 'bending_stiffness': 1.7e-5},
    'fat': {'density': 920, 'young_modulus': 4000, 'poisson_ratio': 0.48, 'damping_ratio': 0.3, 'friction': 0.6},
    'flesh': {'density': 1050, 'young_modulus': 20000, 'poisson_ratio': 0.48, 'damping_ratio': 0.25, 'friction': 0.6},
    'jelly': {'density': 1020, 'young_modulus': 3000, 'poisson_ratio': 0.48, 'damping_ratio': 0.06, 'friction': 0.3},
    'leather': {'density': 860, 'young_modulus': 2e7, 'poisson_ratio': 0.35, 'damping_ratio': 0.2, 'friction': 0.5, 'area_density': 1.03, 'thickness': 0.0012, 'bending_stiffness': 4e-4},
    'muscle': {'density': 1060, 'young_modulus': 30000, 'poisson_ratio': 0.48, 'damping_ratio': 0.2, 'friction': 0.6},
    'rubber': {'density': 930, 'young_modulus': 1.2e6, 'poisson_ratio': 0.48, 'damping_ratio': 0.05, 'friction': 0.9},
    'silk': {'density': 400, 'young_modulus': 1.5e7, 'poisson_ratio': 0.3, 'damping_ratio': 0.08, 'friction': 0.3, 'area_density': 0.06, 'thickness': 0.00015, 'bending_stiffness': 2e-6},
}
